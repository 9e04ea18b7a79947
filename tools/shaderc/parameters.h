// -D: values of the shader's parameters.
#pragma once

#include "tools/shaderc/options.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace moonshade::shaderc {

/// "'a', 'b'", or "none".
std::string quoted_list(const std::vector<std::string>& names);

template <class Named> std::vector<std::string> names_of(const std::vector<Named>& things) {
  std::vector<std::string> names;
  for (const Named& thing : things)
    names.push_back(thing.name);
  return names;
}

/// Reads the values that the call gives; the exit status where one does not fit (the reason is printed).
std::optional<int> read_parameters(const ShaderInfo& info, const Options& options,
                                   std::map<std::string, Constant>& parameters);

} // namespace moonshade::shaderc
