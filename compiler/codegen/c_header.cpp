// The header of a shader's object file (c_interface.h), as text.
#include "compiler/codegen/c_interface.h"

#include <cctype>
#include <cmath>
#include <cstdio>

namespace moonshade::codegen {

namespace {

std::string upper(std::string text) {
  for (char& c : text)
    c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// What may stand inside a comment: no end of it, one line, ASCII's control characters gone.
std::string in_comment(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '/' && !result.empty() && result.back() == '*') result += ' ';
    if (c == '*' && !result.empty() && result.back() == '/') result += ' ';
    result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  if (!result.empty() && result.back() == '\\') result += ' ';
  return result;
}

class HeaderWriter {
public:
  HeaderWriter(const CInterface& interface, const CodeInfo& code) : interface_(interface), code_(code) {}

  std::string write(const std::string& version) {
    open(version);
    common();
    parameters();
    instance();
    for (const CEntry& entry : interface_.entries)
      this->entry(entry);
    sites();
    line("#ifdef __cplusplus\n}\n#endif\n");
    line("#endif");
    return text_;
  }

private:
  void line(const std::string& text) { text_ += text + "\n"; }
  std::string name(const char* what) const { return interface_.prefix + "_" + what; }
  const char* number_type() const { return code_.precision == Precision::F32 ? "float" : "double"; }

  const char* element(ValueType type) const {
    if (type == ValueType::Boolean) return "uint8_t";
    return type == ValueType::Integer ? "int64_t" : number_type();
  }

  void open(const std::string& version) {
    const std::string guard = "MOONSHADE_SHADER_" + upper(interface_.prefix) + "_H";
    line("/* The shader " + in_comment(interface_.file) + " as an object file, for C99 and C++.");
    line(" * Made by " + version + ", precision " + std::string(name_of(code_.precision)) +
         "; do not edit. Make the object with the same options:");
    line(" *");
    line(" *     shaderc --emit=obj [options] -o " + interface_.prefix + ".o " + in_comment(interface_.file));
    line(" *     shaderc --emit=header [options] -o " + interface_.prefix + ".h " + in_comment(interface_.file));
    line(" *     cc main.c " + interface_.prefix + ".o -lm");
    line(" *");
    line(" * Set the parameters once with " + name("instantiate") +
         "(), then shade batches of points, from any number");
    line(" * of threads at once. Points that fault get zeros in their results. */");
    line("#ifndef " + guard + "\n#define " + guard + "\n");
    line("#include <math.h>\n#include <stdbool.h>\n#include <stddef.h>\n#include <stdint.h>\n");
    line("#ifdef __cplusplus\nextern \"C\" {\n#endif\n");
  }

  /// What the headers of several shaders have in common.
  void common() {
    line("#ifndef MOONSHADE_C_INTERFACE\n#define MOONSHADE_C_INTERFACE 1\n");
    line("/* Why a point faults: the values of fault_codes in a batch. */\nenum moonshade_fault {");
    for (int code = 0; code <= static_cast<int>(FaultCode::IntegerRange); ++code) {
      std::string fault = upper(fault_name(static_cast<FaultCode>(code)));
      for (char& c : fault)
        if (c == '-') c = '_';
      line("  MOONSHADE_FAULT_" + fault + " = " + std::to_string(code) +
           (code < static_cast<int>(FaultCode::IntegerRange) ? "," : ""));
    }
    line("};\n");
    line("/* The faults of one batch. A call writes the whole record. */\ntypedef struct moonshade_faults {");
    line("  uint64_t count;       /* points that faulted */");
    line("  uint64_t first_point; /* index of the lowest of them */");
    line("  uint32_t first_site;  /* where it faulted: index into the shader's fault_sites */");
    line("} moonshade_faults;\n");
    line("/* A place in the source that can fault. */\ntypedef struct moonshade_fault_site {");
    line("  const char *file;\n  uint32_t line, column; /* from 1 */");
    line("  const char *kind;      /* \"index\", \"division\", ... */");
    line("  const char *message;   /* of assert and error; else empty */");
    line("} moonshade_fault_site;\n");
    line("#endif /* MOONSHADE_C_INTERFACE */\n");
  }

  // ---- parameters ----

  std::string number_text(double value) const {
    if (std::isnan(value)) return "NAN";
    if (std::isinf(value)) return value < 0 ? "-INFINITY" : "INFINITY";
    const bool narrow = code_.precision == Precision::F32;
    char digits[40];
    std::snprintf(digits, sizeof digits, narrow ? "%.9g" : "%.17g",
                  narrow ? static_cast<double>(static_cast<float>(value)) : value);
    std::string text = digits;
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    if (text.find("inf") != std::string::npos) return value < 0 ? "-INFINITY" : "INFINITY";
    return narrow ? text + "f" : text;
  }

  static std::string integer_text(int64_t value) {
    if (value == INT64_MIN) return "(-INT64_C(9223372036854775807) - 1)";
    return "INT64_C(" + std::to_string(value) + ")";
  }

  /// A string literal of C.
  static std::string literal(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == '"' || c == '\\' || c == '?') { // no trigraphs
        result += std::string("\\") + c;
      } else if (byte < ' ' || byte >= 0x7f) {
        char octal[5];
        std::snprintf(octal, sizeof octal, "\\%03o", byte);
        result += octal;
      } else {
        result += c;
      }
    }
    return result + "\"";
  }

  std::string initialiser(const ParameterInfo& parameter) const {
    const Constant& value = parameter.default_value;
    if (const auto* text = std::get_if<std::string>(&value)) return literal(*text);
    if (const auto* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
    if (const auto* integer = std::get_if<int64_t>(&value))
      return parameter.type == ValueType::Integer ? integer_text(*integer) : number_text(static_cast<double>(*integer));
    if (const auto* number = std::get_if<double>(&value)) return number_text(*number);
    std::string text = "{";
    for (const double component : std::get<std::vector<double>>(value))
      text += (text.size() > 1 ? ", " : "") + number_text(component);
    return text + "}";
  }

  static std::string short_number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
  }

  static std::string about(const ParameterInfo& parameter) {
    std::string text = parameter.doc.empty() ? parameter.label : parameter.doc;
    const auto add = [&](const std::string& more) { text += (text.empty() ? "" : "; ") + more; };
    if (parameter.min && parameter.max) add(short_number(*parameter.min) + " to " + short_number(*parameter.max));
    if (parameter.min && !parameter.max) add("at least " + short_number(*parameter.min));
    if (!parameter.min && parameter.max) add("at most " + short_number(*parameter.max));
    std::string choices;
    for (const Constant& choice : parameter.choices)
      if (const auto* string = std::get_if<std::string>(&choice))
        choices += (choices.empty() ? "" : ", ") + literal(*string);
    if (!choices.empty()) add("one of " + choices);
    return in_comment(text);
  }

  void parameters() {
    line("/* The parameters of the shader. Begin with " + upper(interface_.prefix) + "_DEFAULTS:");
    line(" *     " + name("parameters") + " parameters = " + upper(interface_.prefix) + "_DEFAULTS; */");
    line("typedef struct " + name("parameters") + " {");
    std::string defaults;
    for (const CParameter& parameter : interface_.parameters) {
      const ValueType type = parameter.info.type.value_or(ValueType::Integer);
      const unsigned count = component_count(type);
      std::string field = std::string(type == ValueType::Boolean ? "bool" : element(type)) + " " + parameter.field;
      if (!parameter.info.type) field = "const char *" + parameter.field;
      if (count > 1) field += "[" + std::to_string(count) + "]";
      const std::string comment = about(parameter.info);
      line("  " + field + ";" + (comment.empty() ? "" : " /* " + comment + " */"));
      defaults += (defaults.empty() ? "" : ", ") + initialiser(parameter.info);
    }
    if (interface_.parameters.empty()) line("  char none; /* the shader has no parameters */");
    for (const CParameter& parameter : interface_.strings)
      line("  /* " + in_comment(parameter.info.name) + " is the string '" +
           in_comment(std::get<std::string>(parameter.info.default_value)) + "' in this object */");
    line("} " + name("parameters") + ";");
    line("#define " + upper(interface_.prefix) + "_DEFAULTS {" + (defaults.empty() ? "0" : defaults) + "}\n");
  }

  // ---- functions ----

  void instance() {
    const uint64_t words = std::max<uint64_t>(1, (code_.constants_size + 7) / 8);
    line("/* The shader with its parameters set: plain data, constant once it is made. */");
    line("typedef struct " + name("instance") + " {\n  uint64_t constants[" + std::to_string(words) + "];\n} " +
         name("instance") + ";\n");
    line("/* Makes an instance; `parameters` may be NULL: the defaults. Gives NULL, or what is wrong: a parameter "
         "outside its");
    line(" * range, or a fault of the shader's top level. The instance must then not be used. */");
    line("const char *" + name("instantiate") + "(" + name("instance") + " *instance, const " + name("parameters") +
         " *parameters);\n");
  }

  void fields(const std::vector<std::string>& names, size_t& next, ValueType type, const std::string& about,
              bool output) {
    std::string text = std::string("  ") + (output ? "" : "const ") + element(type) + " ";
    const unsigned count = component_count(type);
    for (unsigned i = 0; i < count; ++i)
      text += (i == 0 ? "*" : ", *") + names[next++];
    line(text + "; /* " + about + " */");
  }

  void entry(const CEntry& entry) {
    line("/* Points for " + entry.symbol + "(): one array a component, each of `count` elements. */");
    line("typedef struct " + entry.symbol + "_batch {\n  uint64_t count;");
    size_t next = 0;
    for (const InputInfo& input : entry.info.inputs)
      fields(entry.inputs, next, input.type, "input " + input.name + ": " + std::string(name_of(input.type)), false);
    next = 0;
    for (size_t i = 0; i < entry.info.results.size(); ++i)
      fields(entry.outputs, next, entry.info.results[i],
             (entry.info.results.size() == 1 ? "result: " : "result " + std::to_string(i + 1) + ": ") +
                 std::string(name_of(entry.info.results[i])),
             true);
    line("  moonshade_faults *faults; /* NULL, or gets the batch's faults */");
    line("  uint8_t *fault_codes;     /* NULL, or gets an enum moonshade_fault for each point */");
    line("} " + entry.symbol + "_batch;");
    line("void " + entry.symbol + "(const " + name("instance") + " *instance, const " + entry.symbol +
         "_batch *batch);\n");
  }

  void sites() {
    line("/* The places that can fault; moonshade_faults.first_site is an index here. */");
    line("#define " + upper(interface_.prefix) + "_FAULT_SITES " + std::to_string(interface_.sites.size()));
    if (!interface_.sites.empty())
      line("extern const moonshade_fault_site " + name("fault_sites") + "[" + std::to_string(interface_.sites.size()) +
           "];");
    line("");
  }

  const CInterface& interface_;
  const CodeInfo& code_;
  std::string text_;
};

} // namespace

std::string c_header(const CInterface& interface, const CodeInfo& code, const std::string& version) {
  return HeaderWriter(interface, code).write(version);
}

} // namespace moonshade::codegen
