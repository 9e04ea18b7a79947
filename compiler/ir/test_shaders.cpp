// For tests: shaders from source text. See test_shaders.h.
#include "compiler/ir/test_shaders.h"

#include "compiler/syntax/parser.h"
#include "stdlib/lua_module.h"
#include "stdlib/lua_vector.h"

#include <cmath>
#include <limits>
#include <lua.hpp>
#include <sstream>

namespace moonshade::ir::test {
namespace {

double number_at(unsigned index, unsigned salt) {
  static constexpr double kNumbers[] = {0.25, -1.75, 3.5, 0.0, 17.125, -0.0, 1e3, 0.1, -2.0, 5.0, 1e-3};
  return kNumbers[(index * 3 + salt * 5) % std::size(kNumbers)];
}

void push(lua_State* state, const Value& value) {
  switch (value.type) {
  case ValueType::Boolean:
    lua_pushboolean(state, value.boolean);
    return;
  case ValueType::Integer:
    lua_pushinteger(state, value.integer);
    return;
  case ValueType::Number:
    lua_pushnumber(state, value.numbers[0]);
    return;
  default:
    push_vector(state, std::span(value.numbers).first(component_count(value.type)));
  }
}

Value value_at(lua_State* state, int index) {
  if (lua_isboolean(state, index)) return Value::of(lua_toboolean(state, index) != 0);
  if (lua_isinteger(state, index)) return Value::of(static_cast<int64_t>(lua_tointeger(state, index)));
  if (lua_type(state, index) == LUA_TNUMBER) return Value::of(lua_tonumber(state, index));
  const std::span<const double> components = vector_at(state, index);
  Value value = Value::of(std::numeric_limits<double>::quiet_NaN());
  if (components.size() < 2) return value;
  value.type = vector_type(static_cast<unsigned>(components.size()));
  std::copy(components.begin(), components.end(), value.numbers.begin());
  return value;
}

} // namespace

Checked check(const std::string& text) {
  Checked checked;
  checked.sources = std::make_unique<SourceSet>();
  checked.arena = std::make_unique<Arena>();
  checked.diagnostics = std::make_unique<Diagnostics>();
  const FileId file = checked.sources->add("test.lua", text);
  const syntax::Chunk* chunk = syntax::parse(*checked.sources, file, *checked.arena, *checked.diagnostics);
  if (!checked.diagnostics->has_errors()) checked.program = sema::check(*chunk, {}, *checked.diagnostics);
  if (checked.diagnostics->has_errors()) {
    std::ostringstream out;
    print_text(*checked.diagnostics, *checked.sources, out);
    checked.errors = out.str();
  }
  return checked;
}

std::vector<Value> inputs_at(const EntryInfo& entry, unsigned index) {
  std::vector<Value> values;
  unsigned salt = 0;
  for (const InputInfo& input : entry.inputs) {
    ++salt;
    if (input.type == ValueType::Boolean) {
      values.push_back(Value::of((index + salt) % 2 == 0));
    } else if (input.type == ValueType::Integer) {
      static constexpr int64_t kIntegers[] = {
          0, 1, 7, -3, 2, std::numeric_limits<int64_t>::max(), std::numeric_limits<int64_t>::min(), -1};
      values.push_back(Value::of(kIntegers[(index + 3 * salt) % std::size(kIntegers)]));
    } else {
      Value value = Value::of(0.0);
      value.type = input.type;
      for (unsigned i = 0; i < component_count(input.type); ++i)
        value.numbers[i] = number_at(index, salt + i);
      values.push_back(value);
    }
  }
  return values;
}

std::vector<Value> parameters_of(const ShaderInfo& info) {
  std::vector<Value> values;
  for (const ParameterInfo& parameter : info.parameters) {
    Value value = Value::of(0.0);
    value.type = parameter.type.value_or(ValueType::Number);
    if (const auto* boolean = std::get_if<bool>(&parameter.default_value)) value.boolean = *boolean;
    if (const auto* integer = std::get_if<int64_t>(&parameter.default_value)) value.integer = *integer;
    if (const auto* number = std::get_if<double>(&parameter.default_value)) value.numbers[0] = *number;
    if (const auto* vector = std::get_if<std::vector<double>>(&parameter.default_value))
      std::copy(vector->begin(), vector->end(), value.numbers.begin());
    values.push_back(value);
  }
  return values;
}

std::string run_lua(const std::string& text, const std::string& entry, const std::vector<Value>& arguments) {
  const std::unique_ptr<lua_State, void (*)(lua_State*)> owner(luaL_newstate(), lua_close);
  lua_State* state = owner.get();
  luaL_openlibs(state);
  luaL_requiref(state, "moonshade", luaopen_moonshade, 0);
  lua_settop(state, 0);
  if (luaL_loadstring(state, text.c_str()) != LUA_OK || lua_pcall(state, 0, 0, 0) != LUA_OK)
    return std::string("load: ") + lua_tostring(state, -1);
  lua_getglobal(state, entry.c_str());
  for (const Value& argument : arguments)
    push(state, argument);
  if (lua_pcall(state, static_cast<int>(arguments.size()), LUA_MULTRET, 0) != LUA_OK) return "fault";
  Outcome outcome;
  for (int i = 1; i <= lua_gettop(state); ++i)
    outcome.results.push_back(value_at(state, i));
  return to_text(outcome);
}

} // namespace moonshade::ir::test
