// The printer. See print.h.
#include "compiler/ir/print.h"

#include <cstdio>
#include <ostream>
#include <sstream>
#include <unordered_map>

namespace moonshade::ir {
namespace {

std::string exact(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    char escaped[8];
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (static_cast<unsigned char>(c) >= 0x20 && c != 0x7f)
      result += c;
    else {
      std::snprintf(escaped, sizeof escaped, "\\x%02x", static_cast<unsigned char>(c));
      result += escaped;
    }
  }
  return result + "\"";
}

std::string typed(std::string_view name, ValueType type, uint32_t count) {
  std::string result = std::string(name) + ": " + std::string(name_of(type));
  return count == 1 ? result : result + "[" + std::to_string(count) + "]";
}

class FunctionPrinter {
public:
  FunctionPrinter(const Module& module, const Function& function, std::ostream& out)
      : module_(module), function_(function), out_(out) {}

  void print_function(std::string_view keyword) {
    out_ << keyword << ' ' << function_.name << '(';
    for (size_t i = 0; i < function_.parameters.size(); ++i) {
      const std::string name = i < function_.parameter_names.size() ? function_.parameter_names[i] : "_";
      out_ << (i == 0 ? "" : ", ") << typed(name, function_.parameters[i], 1);
    }
    out_ << ')';
    for (size_t i = 0; i < function_.results.size(); ++i)
      out_ << (i == 0 ? " -> " : ", ") << name_of(function_.results[i]);
    out_ << " {\n";
    for (VariableId i = 0; i < function_.variables.size(); ++i)
      out_ << "  " << (i < function_.captures ? "capture " : "var ")
           << typed(variable(i), function_.variables[i].type, function_.variables[i].count) << '\n';
    print_block(function_.body, 1);
    out_ << "}\n";
  }

private:
  void print_block(const Block& block, int depth) {
    for (const ValueId id : block.instructions)
      print_instruction(id, depth);
  }

  std::string variable(VariableId id) const {
    const std::string number = "$" + std::to_string(id);
    if (id >= function_.variables.size()) return number + "?";
    return function_.variables[id].name.empty() ? number : number + "." + function_.variables[id].name;
  }

  std::string global(GlobalId id) const {
    const std::string number = "@" + std::to_string(id);
    return id < module_.globals.size() ? number + " " + module_.globals[id].name : number + "?";
  }

  std::string callee(FunctionId id) const {
    return id < module_.functions.size() ? module_.functions[id].name : "?" + std::to_string(id);
  }

  std::string value(ValueId id) {
    const auto found = numbers_.find(id);
    return found == numbers_.end() ? "%?" + std::to_string(id) : "%" + std::to_string(found->second);
  }

  std::string values(const std::vector<ValueId>& ids) {
    std::string result;
    for (size_t i = 0; i < ids.size(); ++i)
      result += (i == 0 ? "" : ", ") + value(ids[i]);
    return result;
  }

  static bool gives_value(const Instruction& instruction, const Module& module) {
    switch (instruction.op) {
    case Op::LoadGlobal:
    case Op::LoadGlobalElement:
    case Op::Load:
    case Op::LoadElement:
      return true;
    case Op::Call:
      return instruction.index >= module.functions.size() || !module.functions[instruction.index].results.empty();
    default:
      return info(instruction.op).shape == OpShape::Value;
    }
  }

  void print_instruction(ValueId id, int depth) {
    if (id >= function_.instructions.size()) {
      out_ << std::string(2 * depth, ' ') << "?" << id << '\n';
      return;
    }
    const Instruction& instruction = function_.instructions[id];
    const std::string operands = values(instruction.operands);
    out_ << std::string(2 * depth, ' ');
    if (gives_value(instruction, module_)) {
      numbers_.emplace(id, static_cast<uint32_t>(numbers_.size()));
      out_ << value(id) << ": " << name_of(instruction.type) << " = ";
    }
    out_ << info(instruction.op).name;
    print_details(instruction, operands, depth);
    out_ << '\n';
  }

  void print_details(const Instruction& instruction, const std::string& operands, int depth) {
    switch (instruction.op) {
    case Op::ConstBoolean:
      out_ << (instruction.integer ? " true" : " false");
      return;
    case Op::ConstInteger:
      out_ << ' ' << instruction.integer;
      return;
    case Op::ConstNumber:
      out_ << ' ' << exact(instruction.number);
      return;
    case Op::Argument:
      out_ << ' ' << instruction.index;
      return;
    case Op::LoadGlobal:
      out_ << ' ' << global(instruction.index);
      return;
    case Op::StoreGlobal:
    case Op::LoadGlobalElement:
    case Op::StoreGlobalElement:
      out_ << ' ' << global(instruction.index) << ", " << operands;
      return;
    case Op::Load:
      out_ << ' ' << variable(instruction.index);
      return;
    case Op::Store:
    case Op::LoadElement:
    case Op::StoreElement:
      out_ << ' ' << variable(instruction.index) << ", " << operands;
      return;
    case Op::Component:
    case Op::Result:
      out_ << ' ' << instruction.index << ", " << operands;
      return;
    case Op::CallLibrary:
      out_ << ' ' << (instruction.library ? instruction.library->symbol : "?") << '(' << operands << ')';
      return;
    case Op::Call:
      out_ << ' ' << callee(instruction.index) << '(' << operands << ')';
      for (size_t i = 0; i < instruction.variables.size(); ++i)
        out_ << (i == 0 ? " captures " : ", ") << variable(instruction.variables[i]);
      return;
    case Op::If:
      out_ << ' ' << operands << " {\n";
      print_block(instruction.blocks.at(0), depth + 1);
      if (!instruction.blocks.at(1).instructions.empty()) {
        out_ << std::string(2 * depth, ' ') << "} else {\n";
        print_block(instruction.blocks[1], depth + 1);
      }
      out_ << std::string(2 * depth, ' ') << '}';
      return;
    case Op::Loop:
    case Op::Scope:
      out_ << " #" << instruction.index << " {\n";
      print_block(instruction.blocks.at(0), depth + 1);
      out_ << std::string(2 * depth, ' ') << '}';
      return;
    case Op::Break:
      out_ << " #" << instruction.index;
      return;
    case Op::Fault:
      out_ << ' ' << operands << ", " << fault_name(instruction.fault);
      if (!instruction.text.empty()) out_ << ' ' << quoted(instruction.text);
      return;
    case Op::Print:
      out_ << ' ' << quoted(instruction.text) << (operands.empty() ? "" : ", ") << operands;
      return;
    default:
      out_ << (operands.empty() ? "" : " ") << operands;
      return;
    }
  }

  const Module& module_;
  const Function& function_;
  std::ostream& out_;
  std::unordered_map<ValueId, uint32_t> numbers_;
};

} // namespace

void print(const Module& module, std::ostream& out) {
  for (GlobalId i = 0; i < module.globals.size(); ++i) {
    const Global& global = module.globals[i];
    out << "global @" << i << ' ' << typed(global.name, global.type, global.count);
    if (global.has_data()) out << ", data";
    if (global.parameter != kNone) out << ", parameter " << global.parameter;
    out << '\n';
  }
  for (const Entry& entry : module.entries)
    out << "entry " << entry.name << " = "
        << (entry.function < module.functions.size() ? module.functions[entry.function].name : "?") << '\n';
  for (FunctionId i = 0; i < module.functions.size(); ++i) {
    if (i != 0 || !module.globals.empty() || !module.entries.empty()) out << '\n';
    FunctionPrinter(module, module.functions[i], out).print_function(i == module.init ? "init" : "function");
  }
}

std::string to_text(const Module& module) {
  std::ostringstream out;
  print(module, out);
  return out.str();
}

std::string to_text(const Module& module, const Function& function) {
  std::ostringstream out;
  FunctionPrinter(module, function, out).print_function("function");
  return out.str();
}

} // namespace moonshade::ir
