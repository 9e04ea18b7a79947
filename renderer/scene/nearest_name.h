// The known name nearest to a misspelt one, for messages.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace moonshade::renderer {

/// The nearest of `known` by edits, or empty where none is near.
std::string nearest_name(std::string_view name, std::span<const std::string_view> known);

/// "; did you mean 'x'?" or empty.
std::string did_you_mean(std::string_view name, std::span<const std::string_view> known);

/// "a, b, c".
std::string join_names(std::span<const std::string_view> names);

} // namespace moonshade::renderer
