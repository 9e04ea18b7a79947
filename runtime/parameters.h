// Values of a shader's parameters, as hosts give them.
#pragma once

#include "compiler/sema/shader_info.h"

#include <map>
#include <string>
#include <vector>

namespace moonshade {

/// The value of each parameter, in their order: as given, or its default. Gives the error, which names the parameter.
std::string parameter_values(const ShaderInfo& info, const std::map<std::string, Constant>& given,
                             std::vector<Constant>& values);

/// What compiled code gets for a parameter: of a string its index, else the value.
Constant stored_value(const ParameterInfo& parameter, const Constant& value);

} // namespace moonshade
