// Names and layouts of a shader's interface for C (c_interface.h).
#include "compiler/codegen/c_interface.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace moonshade::codegen {

namespace {

/// Words that cannot be a field's name in C or in C++.
const std::set<std::string, std::less<>>& reserved_words() {
  static const std::set<std::string, std::less<>> words = {"alignas",       "alignof",      "and",
                                                           "and_eq",        "asm",          "auto",
                                                           "bitand",        "bitor",        "bool",
                                                           "break",         "case",         "catch",
                                                           "char",          "class",        "co_await",
                                                           "co_return",     "co_yield",     "compl",
                                                           "concept",       "const",        "const_cast",
                                                           "consteval",     "constexpr",    "constinit",
                                                           "continue",      "decltype",     "default",
                                                           "delete",        "do",           "double",
                                                           "else",          "dynamic_cast", "enum",
                                                           "explicit",      "export",       "extern",
                                                           "false",         "float",        "for",
                                                           "friend",        "goto",         "if",
                                                           "inline",        "int",          "long",
                                                           "mutable",       "namespace",    "new",
                                                           "noexcept",      "not",          "not_eq",
                                                           "nullptr",       "operator",     "or",
                                                           "or_eq",         "private",      "protected",
                                                           "public",        "register",     "requires",
                                                           "restrict",      "return",       "short",
                                                           "signed",        "sizeof",       "static",
                                                           "static_assert", "static_cast",  "struct",
                                                           "switch",        "template",     "this",
                                                           "throw",         "thread_local", "reinterpret_cast",
                                                           "true",          "try",          "typedef",
                                                           "typeid",        "typename",     "union",
                                                           "unsigned",      "using",        "virtual",
                                                           "void",          "volatile",     "wchar_t",
                                                           "while",         "xor",          "xor_eq",
                                                           "char8_t",       "char16_t",     "char32_t",
                                                           "typeof",        "unix",         "linux",
                                                           "errno"};
  return words;
}

/// `text` as an identifier.
std::string identifier(std::string_view text) {
  std::string name;
  for (const char c : text)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ? c : '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0) name.insert(0, "_");
  return name;
}

/// An identifier that is no reserved word and none of `taken`, to which it is added.
std::string field_name(std::string_view text, std::set<std::string>& taken) {
  std::string name = identifier(text);
  if (reserved_words().contains(name)) name += '_';
  while (!taken.insert(name).second)
    name += '_';
  return name;
}

std::string prefix_of(const std::string& file) {
  std::string_view stem = file;
  if (const size_t slash = stem.rfind('/'); slash != std::string_view::npos) stem.remove_prefix(slash + 1);
  if (stem.ends_with(".lua")) stem.remove_suffix(4);
  std::string name = identifier(stem);
  // An underscore in front belongs to the language.
  return name[0] == '_' ? "shader" + name : name;
}

void add_components(const std::string& name, ValueType type, std::set<std::string>& taken,
                    std::vector<std::string>& fields) {
  const unsigned count = component_count(type);
  for (unsigned i = 0; i < count; ++i) {
    const std::string component = count == 1        ? ""
                                  : is_vector(type) ? std::string("_") + "xyzw"[i]
                                                    : "_" + std::to_string(i);
    fields.push_back(field_name(name + component, taken));
  }
}

CEntry c_entry(const EntryInfo& info, const std::string& prefix) {
  static const std::set<std::string, std::less<>> own = {"instantiate", "instance", "parameters", "fault_sites",
                                                         "PARAMETERS"};
  CEntry entry{info, prefix + "_" + info.name + (own.contains(info.name) ? "_entry" : ""), {}, {}};
  std::set<std::string> taken = {"count", "faults", "fault_codes"};
  for (const InputInfo& input : info.inputs)
    add_components(input.name, input.type, taken, entry.inputs);
  for (size_t i = 0; i < info.results.size(); ++i)
    add_components(info.results.size() == 1 ? "result" : "result" + std::to_string(i + 1), info.results[i], taken,
                   entry.outputs);
  return entry;
}

uint32_t size_in_struct(ValueType type, Precision precision) {
  if (type == ValueType::Boolean) return 1;
  return type == ValueType::Integer || precision == Precision::F64 ? 8 : 4;
}

uint32_t align_to(uint32_t offset, uint32_t alignment) { return (offset + alignment - 1) / alignment * alignment; }

void add_parameters(CInterface& interface, const ShaderInfo& info, const ir::Module& module, const CodeInfo& code) {
  std::set<std::string> taken;
  uint32_t offset = 0;
  for (size_t i = 0; i < info.parameters.size(); ++i) {
    CParameter parameter{info.parameters[i], field_name(info.parameters[i].name, taken), 0, UINT32_MAX};
    if (!parameter.info.type && parameter.info.compared.empty()) {
      interface.strings.push_back(std::move(parameter));
      continue;
    }
    const ValueType type = parameter.info.type.value_or(ValueType::Integer); // a pointer is as large
    const uint32_t size = size_in_struct(type, code.precision);
    parameter.source = align_to(offset, size);
    offset = parameter.source + size * component_count(type);
    interface.parameters_alignment = std::max(interface.parameters_alignment, size);
    for (size_t global = 0; global < module.globals.size(); ++global)
      if (module.globals[global].parameter == i) parameter.target = static_cast<uint32_t>(code.global_offsets[global]);
    interface.parameters.push_back(std::move(parameter));
  }
  interface.parameters_size = std::max(1U, align_to(offset, interface.parameters_alignment));
}

} // namespace

CInterface c_interface(const std::string& file, const std::string& prefix, const ShaderInfo& info,
                       const ir::Module& module, const CodeInfo& code, std::vector<CSite> sites) {
  CInterface interface;
  interface.file = file;
  interface.prefix = prefix.empty() ? prefix_of(file) : prefix;
  interface.sites = std::move(sites);
  for (const EntryInfo& entry : info.entries)
    interface.entries.push_back(c_entry(entry, interface.prefix));
  add_parameters(interface, info, module, code);
  return interface;
}

} // namespace moonshade::codegen
