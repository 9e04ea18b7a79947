// -D (parameters.h).
#include "tools/shaderc/parameters.h"

#include <algorithm>

namespace moonshade::shaderc {

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += (text.empty() ? "'" : ", '") + name + "'";
  return text.empty() ? "none" : text;
}

std::optional<int> read_parameters(const ShaderInfo& info, const Options& options,
                                   std::map<std::string, Constant>& parameters) {
  for (const std::string& definition : options.definitions) {
    const Assignment assignment = split_assignment(definition);
    const auto parameter = std::find_if(info.parameters.begin(), info.parameters.end(),
                                        [&](const ParameterInfo& p) { return p.name == assignment.name; });
    if (parameter == info.parameters.end())
      return call_error("-D: the shader has no parameter '" + std::string(assignment.name) + "'; there are " +
                        quoted_list(names_of(info.parameters)));
    CheckedConstant checked = parse_override(*parameter, assignment.value);
    if (!checked.error.empty()) return call_error("-D: " + checked.error);
    parameters[parameter->name] = std::move(checked.value);
  }
  return std::nullopt;
}

} // namespace moonshade::shaderc
