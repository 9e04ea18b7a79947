// Values of parameters (parameters.h).
#include "runtime/parameters.h"

#include <algorithm>

namespace moonshade {

std::string parameter_values(const ShaderInfo& info, const std::map<std::string, Constant>& given,
                             std::vector<Constant>& values) {
  for (const auto& [name, value] : given)
    if (std::ranges::find(info.parameters, name, &ParameterInfo::name) == info.parameters.end())
      return "the shader has no parameter '" + name + "'";
  for (const ParameterInfo& parameter : info.parameters) {
    const auto override_value = given.find(parameter.name);
    if (override_value == given.end()) {
      values.push_back(parameter.default_value);
      continue;
    }
    CheckedConstant checked = check_override(parameter, override_value->second);
    if (!checked.error.empty()) return checked.error;
    values.push_back(std::move(checked.value));
  }
  return {};
}

Constant stored_value(const ParameterInfo& parameter, const Constant& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? Constant(compared_index(parameter, *text)) : value;
}

} // namespace moonshade
