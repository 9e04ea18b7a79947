// --describe: what a host may know of a shader, as JSON.
#include "tools/shaderc/describe.h"

#include <nlohmann/json.hpp>

namespace moonshade::shaderc {

namespace {

using Json = nlohmann::ordered_json;

Json describe_constant(const Constant& constant) {
  return std::visit([](const auto& value) { return Json(value); }, constant);
}

Json describe_entry(const EntryInfo& entry) {
  Json inputs = Json::array(), results = Json::array();
  for (const InputInfo& input : entry.inputs)
    inputs.push_back({{"name", input.name}, {"type", name_of(input.type)}});
  for (ValueType type : entry.results)
    results.push_back(name_of(type));
  Json json = {{"name", entry.name}, {"inputs", inputs}, {"results", results}};
  if (entry.results.size() == 1) json["result"] = name_of(entry.results[0]);
  return json;
}

Json describe_parameter(const ParameterInfo& parameter) {
  Json json = {{"name", parameter.name},
               {"type", parameter.type ? name_of(*parameter.type) : "string"},
               {"default", describe_constant(parameter.default_value)}};
  if (parameter.min) json["min"] = *parameter.min;
  if (parameter.max) json["max"] = *parameter.max;
  if (parameter.step) json["step"] = *parameter.step;
  if (!parameter.doc.empty()) json["doc"] = parameter.doc;
  if (!parameter.label.empty()) json["label"] = parameter.label;
  for (const Constant& choice : parameter.choices)
    json["choices"].push_back(describe_constant(choice));
  return json;
}

} // namespace

std::string describe(const std::string& file, const ShaderInfo& info) {
  Json json = {{"file", file},
               {"entries", Json::array()},
               {"parameters", Json::array()},
               {"modules", info.modules},
               {"images", Json::array()}};
  for (const ImageInfo& image : info.images) {
    Json described = {{"file", image.file}, {"raw", image.raw}};
    if (image.parameter) described["parameter"] = info.parameters[*image.parameter].name;
    json["images"].push_back(std::move(described));
  }
  for (const EntryInfo& entry : info.entries)
    json["entries"].push_back(describe_entry(entry));
  for (const ParameterInfo& parameter : info.parameters)
    json["parameters"].push_back(describe_parameter(parameter));
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

} // namespace moonshade::shaderc
