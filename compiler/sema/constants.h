// Values of constant expressions: what the default and the metadata of a parameter may be.
#pragma once

#include "compiler/sema/shader_info.h"
#include "compiler/syntax/ast.h"

#include <functional>
#include <optional>

namespace moonshade::sema {

/// The type that stock Lua gives a number's literal, and its value.
std::optional<double> number_of(const Constant& constant);

/// What the names in constant expressions stand for: a library constant or vector constructor by its full name
/// ("math.pi", "vec3"), null where the shader gives the name another meaning.
using LibraryNameOf = std::function<std::string_view(const syntax::Expr&)>;

/// The value of a literal, of arithmetic on constants, or of a vector constructor of constants; nothing for anything
/// else.
std::optional<Constant> evaluate_constant(const syntax::Expr& expr, const LibraryNameOf& library_name);

} // namespace moonshade::sema
