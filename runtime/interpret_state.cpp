// One sandboxed Lua state. Lua (built as C) leaves functions by longjmp, so the C functions here hold nothing that has
// a destructor, and what they have to tell stands in a Record at a fixed address that the state's extra space points
// to.
#include "runtime/interpret_state.h"

#include "stdlib/lua_images.h"
#include "stdlib/lua_module.h"
#include "stdlib/lua_sums.h"
#include "stdlib/lua_vector.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <lua.hpp>
#include <utility>

namespace moonshade {

/// What the functions that shaders call leave behind for us.
struct InterpretState::Record {
  FaultCode code = FaultCode::None;
  uint32_t file = 0; ///< in InterpretSource::files
  uint32_t line = 0;
  char message[400] = "";
  uint64_t steps_left = 0;
  bool loads = true; ///< Lua's own compiler takes the files
  const InterpretSource* source = nullptr;
  const PrintSink* prints = nullptr; ///< where the lines of a call go, if anywhere

  void clear() {
    code = FaultCode::None;
    file = line = 0;
    message[0] = 0;
  }
};

namespace {

using Record = InterpretState::Record;

/// Raised in place of a message once the Record says what happened.
constexpr char kRecorded = 0;
/// The metatable of tables that the shader constructs.
constexpr char kCheckedTable[] = "moonshade.checked";

Record& record_of(lua_State* lua) { return **static_cast<Record**>(lua_getextraspace(lua)); }

/// Notes the file and line that run, seen from a C function or a message handler; line 0 where Lua does not know any
/// more (a call in tail position). Chunks are named by their number among the files.
void note_place(lua_State* lua, Record& record) {
  lua_Debug frame;
  if (!record.loads) return; // load_file has said which file
  record.file = record.line = 0;
  for (int level = 0; lua_getstack(lua, level, &frame); ++level) {
    if (!lua_getinfo(lua, "Sl", &frame) || frame.currentline <= 0) continue;
    record.file = uint32_t(std::strtoul(frame.source + 1, nullptr, 10));
    record.line = uint32_t(frame.currentline);
    return;
  }
}

int raise_fault(lua_State* lua, FaultCode code, const char* message) {
  Record& record = record_of(lua);
  record.code = code;
  note_place(lua, record);
  std::snprintf(record.message, sizeof record.message, "%s", message);
  lua_pushlightuserdata(lua, const_cast<char*>(&kRecorded));
  return lua_error(lua);
}

// ---- what shaders call ---------------------------------------------------------------------------------------------

int checked_assert(lua_State* lua) {
  if (lua_toboolean(lua, 1)) return lua_gettop(lua);
  const char* message = lua_type(lua, 2) == LUA_TSTRING ? lua_tostring(lua, 2) : "assertion failed!";
  return raise_fault(lua, FaultCode::Assert, message);
}

int raise_error(lua_State* lua) {
  return raise_fault(lua, FaultCode::Error, lua_type(lua, 1) == LUA_TSTRING ? lua_tostring(lua, 1) : "");
}

/// math.floor and math.ceil of Lua's own library, but a fault where those would go on with a float.
template <double (*Round)(double)> int to_integer(lua_State* lua) {
  if (lua_isinteger(lua, 1)) {
    lua_settop(lua, 1);
    return 1;
  }
  lua_Integer integer;
  if (!lua_numbertointeger(Round(luaL_checknumber(lua, 1)), &integer))
    return raise_fault(lua, FaultCode::IntegerRange, "");
  lua_pushinteger(lua, integer);
  return 1;
}

/// math.tointeger, but a fault where that would give nil.
int exact_integer(lua_State* lua) {
  int is_integer = 0;
  const lua_Integer integer = lua_tointegerx(lua, 1, &is_integer);
  if (!is_integer) return raise_fault(lua, FaultCode::IntegerRange, "");
  lua_pushinteger(lua, integer);
  return 1;
}

/// Pushes the text of a value as Lua's tostring has it, but every NaN as `nan`.
void push_text(lua_State* lua, int index) {
  luaL_tolstring(lua, index, nullptr);
  const int type = lua_type(lua, index);
  if (type == LUA_TSTRING || (type == LUA_TNUMBER && lua_isinteger(lua, index))) return;
  luaL_gsub(lua, lua_tostring(lua, -1), "-nan", "nan");
  lua_remove(lua, -2);
}

/// Lua's print, to the sink of the call.
int print_line(lua_State* lua) {
  const PrintSink* sink = record_of(lua).prints;
  if (sink == nullptr) return 0;
  const int count = lua_gettop(lua);
  luaL_checkstack(lua, 2 * count + 1, "too many arguments to 'print'");
  for (int i = 1; i <= count; ++i) {
    if (i > 1) lua_pushliteral(lua, "\t");
    push_text(lua, i);
  }
  lua_concat(lua, lua_gettop(lua) - count);
  size_t size = 0;
  const char* text = lua_tolstring(lua, -1, &size);
  (*sink)({text, size});
  return 0;
}

/// math.modf, but a fault where the first result would be a float.
int split_number(lua_State* lua) {
  lua_Integer whole;
  if (lua_isinteger(lua, 1)) {
    lua_settop(lua, 1);
    lua_pushnumber(lua, 0);
    return 2;
  }
  const lua_Number number = luaL_checknumber(lua, 1), truncated = std::trunc(number);
  if (!lua_numbertointeger(truncated, &whole)) return raise_fault(lua, FaultCode::IntegerRange, "");
  lua_pushinteger(lua, whole);
  lua_pushnumber(lua, number == truncated ? 0 : number - truncated);
  return 2;
}

int count_step(lua_State* lua) {
  Record& record = record_of(lua);
  if (record.steps_left == 0) return raise_fault(lua, FaultCode::StepLimit, "");
  --record.steps_left;
  return 0;
}

/// gradient and fwidth: stock Lua's evaluate their function at many points where compiled code evaluates it at one. It
/// is that one that faults and whose steps count; the others have an allowance of their own. Upvalue 1: the module's.
int counted_derivative(lua_State* lua) {
  constexpr uint64_t kEvaluations = 40; // more than 8 for each of 4 components
  Record& record = record_of(lua);
  const uint64_t before = record.steps_left;
  if (lua_isfunction(lua, 1) && lua_gettop(lua) >= 2) {
    lua_pushvalue(lua, 1);
    if (lua_isinteger(lua, 2))
      lua_pushnumber(lua, lua_tonumber(lua, 2));
    else
      lua_pushvalue(lua, 2);
    lua_call(lua, 1, 0);
  }
  const uint64_t left = record.steps_left;
  record.steps_left = before <= UINT64_MAX / kEvaluations ? before * kEvaluations : before;
  const PrintSink* prints = std::exchange(record.prints, nullptr);
  lua_pushvalue(lua, lua_upvalueindex(1));
  lua_insert(lua, 1);
  lua_call(lua, lua_gettop(lua) - 1, 1);
  record.steps_left = left;
  record.prints = prints;
  return 1;
}

/// For the module's texture, by the path of compiled code. `context`: the InterpretSource.
const char* look_up_image(const void* context, const char* file, unsigned from, bool raw, const double* at,
                          double* rgba) {
  const auto& source = *static_cast<const InterpretSource*>(context);
  const size_t image = source.images->find(file, source.files[from].name, raw);
  if (image == source.images->size()) return "the shader does not name it";
  source.images->look_up(image, 1, 4, nullptr, at, rgba);
  return nullptr;
}

// ---- errors of Lua's own -------------------------------------------------------------------------------------------

/// Of a vector's component that there is not: the index may be no integer at all.
FaultCode classify_component(const char* index) {
  const size_t size = std::strcspn(index, "]");
  if (std::strcspn(index, ".ein") >= size) return FaultCode::Index; // an integer
  const double number = std::strtod(index, nullptr);
  // The text has 14 digits: of -2^63 it is this number, and of 2^63 its negative.
  constexpr double kEdge = 9.2233720368548e+18;
  const bool is_integer = number == std::floor(number) && number >= -kEdge && number < kEdge;
  return is_integer ? FaultCode::Index : FaultCode::IntegerRange;
}

FaultCode classify(const char* message) {
  const auto says = [&](const char* part) { return std::strstr(message, part) != nullptr; };
  if (says("attempt to perform 'n//0'") || says("attempt to divide by zero")) return FaultCode::DivideByZero;
  if (says("attempt to perform 'n%%0'") || says("attempt to perform 'n%0'")) return FaultCode::DivideByZero;
  if (says("bad argument #2 to 'fmod' (zero)")) return FaultCode::DivideByZero;
  if (says("'for' step is zero")) return FaultCode::ForStepZero;
  if (says("number has no integer representation")) return FaultCode::IntegerRange;
  constexpr const char* kNoComponent = "has no component [";
  if (const char* found = std::strstr(message, kNoComponent))
    return classify_component(found + std::strlen(kNoComponent));
  if (says("attempt to index") || says("out of range")) return FaultCode::Index;
  return FaultCode::Error;
}

/// Runs while the stack of the error still stands, so that the line can be told.
int note_error(lua_State* lua) {
  if (lua_touserdata(lua, 1) == &kRecorded) return 1;
  Record& record = record_of(lua);
  const char* message = lua_type(lua, 1) == LUA_TSTRING ? lua_tostring(lua, 1) : "an error that is no message";
  record.code = classify(message);
  note_place(lua, record);
  std::snprintf(record.message, sizeof record.message, "%s", record.code == FaultCode::Error ? message : "");
  return 1;
}

constexpr int kHandler = 1; // its place on the stack, below everything else

int protected_call(lua_State* lua, int arguments, int results) {
  const int status = lua_pcall(lua, arguments, results, kHandler);
  if (status == LUA_OK) return status;
  Record& record = record_of(lua);
  if (record.code == FaultCode::None) { // no handler runs for these
    record.code = FaultCode::Error;
    std::snprintf(record.message, sizeof record.message, "%s",
                  status == LUA_ERRMEM ? "not enough memory" : "error in Lua");
  }
  return status;
}

/// A key that a table of the dialect does not have: elements are asked for by number, fields by names that are known.
int missing_key(lua_State* lua) {
  if (lua_type(lua, 2) != LUA_TNUMBER) return 0;
  int is_integer = 0;
  lua_tointegerx(lua, 2, &is_integer);
  return raise_fault(lua, is_integer ? FaultCode::Index : FaultCode::IntegerRange, "");
}

/// ipairs over a table with that metatable, which ends at the table's last element.
int raw_ipairs(lua_State* lua) {
  lua_pushcfunction(lua, [](lua_State* state) {
    const lua_Integer next = lua_tointeger(state, 2) + 1;
    lua_pushinteger(state, next);
    return lua_rawgeti(state, 1, next) == LUA_TNIL ? 1 : 2;
  });
  lua_pushvalue(lua, 1);
  lua_pushinteger(lua, 0);
  return 3;
}

// ---- the sandbox ---------------------------------------------------------------------------------------------------

void load_file(lua_State* lua, uint32_t file) {
  const std::string& text = record_of(lua).source->files[file].loaded;
  char name[16];
  std::snprintf(name, sizeof name, "=%u", file);
  if (luaL_loadbufferx(lua, text.data(), text.size(), name, "t") != LUA_OK) {
    record_of(lua).loads = false;
    record_of(lua).file = file;
    lua_error(lua);
  }
  if (file == 0 || record_of(lua).source->images->size() == 0) return;
  // The names of images in a module begin in its own folder: globals as they are, but for a texture of its own.
  lua_newtable(lua);
  push_texture(lua, file);
  lua_setfield(lua, -2, "texture");
  lua_createtable(lua, 0, 2);
  for (const char* field : {"__index", "__newindex"}) {
    lua_pushglobaltable(lua);
    lua_setfield(lua, -2, field);
  }
  lua_setmetatable(lua, -2);
  lua_setupvalue(lua, -2, 1);
}

/// As Lua's own: runs the file once, and keeps its first result.
int require_module(lua_State* lua) {
  luaL_checkstring(lua, 1);
  lua_settop(lua, 1);
  luaL_getsubtable(lua, LUA_REGISTRYINDEX, "moonshade.modules");
  lua_pushvalue(lua, 1);
  if (lua_rawget(lua, 2) != LUA_TNIL) return 1;
  const auto& files = record_of(lua).source->files;
  for (uint32_t i = 1; i < files.size(); ++i) {
    if (files[i].module != lua_tostring(lua, 1)) continue;
    load_file(lua, i);
    lua_call(lua, 0, 1);
    if (lua_isnil(lua, -1)) lua_pushboolean(lua, 1);
    lua_pushvalue(lua, 1);
    lua_pushvalue(lua, -2);
    lua_rawset(lua, 2);
    return 1;
  }
  return luaL_error(lua, "there is no module '%s'", lua_tostring(lua, 1));
}

void set_field(lua_State* lua, int table, const char* name, lua_CFunction function) {
  lua_pushcfunction(lua, function);
  lua_setfield(lua, table, name);
}

/// Of the basic library, what the dialect has.
void open_basics(lua_State* lua) {
  luaL_requiref(lua, "_G", luaopen_base, 0);
  lua_newtable(lua);
  lua_getfield(lua, -2, "type");
  lua_setfield(lua, -2, "type");
  set_field(lua, lua_absindex(lua, -1), "ipairs", raw_ipairs);
  set_field(lua, lua_absindex(lua, -1), "assert", checked_assert);
  set_field(lua, lua_absindex(lua, -1), "error", raise_error);
  set_field(lua, lua_absindex(lua, -1), "require", require_module);
  set_field(lua, lua_absindex(lua, -1), "print", print_line);
  lua_rawseti(lua, LUA_REGISTRYINDEX, LUA_RIDX_GLOBALS);
  lua_pop(lua, 1);
}

void open_math(lua_State* lua) {
  luaL_requiref(lua, "math", luaopen_math, 0);
  set_field(lua, -2, "floor", to_integer<std::floor>);
  set_field(lua, -2, "ceil", to_integer<std::ceil>);
  set_field(lua, -2, "tointeger", exact_integer);
  set_field(lua, -2, "modf", split_number);
  for (const char* name : {"random", "randomseed"}) {
    lua_pushnil(lua);
    lua_setfield(lua, -2, name);
  }
  lua_setglobal(lua, "math");
}

/// Around the module's gradient and fwidth.
void open_derivatives(lua_State* lua) {
  for (const char* name : {"gradient", "fwidth"}) {
    lua_getglobal(lua, name);
    lua_pushcclosure(lua, counted_derivative, 1);
    lua_setglobal(lua, name);
  }
}

/// Calling a string counts a step, or checks the accesses of its argument from then on (interpret_steps.h).
int count_or_check(lua_State* lua) {
  if (lua_gettop(lua) < 2) return count_step(lua);
  luaL_setmetatable(lua, kCheckedTable);
  return 1;
}

void open_steps(lua_State* lua) {
  lua_pushliteral(lua, "");
  lua_newtable(lua);
  set_field(lua, lua_absindex(lua, -1), "__call", count_or_check);
  lua_setmetatable(lua, -2);
  luaL_newmetatable(lua, kCheckedTable);
  set_field(lua, lua_absindex(lua, -1), "__index", missing_key);
  set_field(lua, lua_absindex(lua, -1), "__newindex", missing_key);
  lua_pop(lua, 2);
}

void push_constant(lua_State* lua, const Constant& constant) {
  if (const bool* boolean = std::get_if<bool>(&constant))
    lua_pushboolean(lua, *boolean);
  else if (const int64_t* integer = std::get_if<int64_t>(&constant))
    lua_pushinteger(lua, *integer);
  else if (const double* number = std::get_if<double>(&constant))
    lua_pushnumber(lua, *number);
  else if (const auto* vector = std::get_if<std::vector<double>>(&constant))
    push_vector(lua, *vector);
  else
    lua_pushlstring(lua, std::get<std::string>(constant).data(), std::get<std::string>(constant).size());
}

} // namespace

InterpretState::InterpretState(const InterpretSource& source) : source_(source), record_(std::make_unique<Record>()) {}

InterpretState::~InterpretState() {
  if (lua_) lua_close(lua_);
}

std::unique_ptr<InterpretState> InterpretState::open(const InterpretSource& source, std::string& error) {
  std::unique_ptr<InterpretState> state(new InterpretState(source));
  return state->load(error) ? std::move(state) : nullptr;
}

void InterpretState::start_counting(uint64_t limit) { record_->steps_left = limit; }

uint64_t InterpretState::steps_left() const { return record_->steps_left; }

bool InterpretState::load(std::string& error) {
  lua_ = luaL_newstate();
  if (!lua_) {
    error = "no memory for a Lua state";
    return false;
  }
  *static_cast<Record**>(lua_getextraspace(lua_)) = record_.get();
  record_->source = &source_;
  images_ = {&source_, look_up_image};
  lua_pushcfunction(lua_, note_error);
  // Everything that can raise an error, out of memory included, happens inside a protected call.
  lua_pushcfunction(lua_, [](lua_State* lua) {
    const auto& state = *static_cast<const InterpretState*>(lua_touserdata(lua, 1));
    const InterpretSource& source = state.source_;
    open_basics(lua);
    open_math(lua);
    luaL_requiref(lua, "moonshade", luaopen_moonshade, 0);
    lua_pop(lua, 1);
    open_steps(lua);
    open_derivatives(lua);
    set_images(lua, &state.images_);
    if (source.library != 0) {
      char name[16];
      std::snprintf(name, sizeof name, "=%u", source.library);
      load_sums(lua, source.files[source.library].loaded, name);
    }
    for (const auto& [name, value] : source.parameters) {
      push_constant(lua, value);
      override_parameter(lua, name.c_str());
    }
    load_file(lua, 0);
    lua_call(lua, 0, 0);
    lua_settop(lua, 0);
    luaL_checkstack(lua, int(source.info.entries.size()), "too many entry points");
    for (const EntryInfo& entry : source.info.entries)
      lua_getglobal(lua, entry.name.c_str());
    return int(source.info.entries.size());
  });
  lua_pushlightuserdata(lua_, this);
  start_counting(source_.step_limit);
  if (protected_call(lua_, 1, LUA_MULTRET) == LUA_OK) return lua_checkstack(lua_, 200);
  // What the parser takes and Lua does not exceeds one of Lua's capacities (locals, upvalues, nesting).
  if (!record_->loads)
    error = source_.files[record_->file].name + ": stock Lua cannot load this file: " + record_->message;
  else
    error = describe_top_level_fault(last_fault());
  return false;
}

InterpretFault InterpretState::last_fault() const {
  const InterpretSource::File& file = source_.files[record_->file < source_.files.size() ? record_->file : 0];
  return {record_->code, file.name, place_of_fault(file.text, record_->code, record_->line), record_->message};
}

FaultCode InterpretState::call(size_t index, const Batch& batch, uint64_t row, uint64_t step_limit,
                               const PrintSink* prints) {
  const EntryInfo& entry = source_.info.entries[index];
  record_->clear();
  record_->prints = prints;
  start_counting(step_limit);
  lua_pushvalue(lua_, kHandler + 1 + int(index));
  push_inputs(entry, batch, row);
  const int base = lua_gettop(lua_) - int(entry.inputs.size());
  FaultCode code = FaultCode::None;
  if (protected_call(lua_, int(entry.inputs.size()), int(entry.results.size())) != LUA_OK)
    code = record_->code;
  else
    code = store_results(entry, batch, row);
  if (code != FaultCode::None) store_zeros(entry, batch, row);
  lua_settop(lua_, base - 1);
  record_->prints = nullptr;
  return code;
}

void InterpretState::push_inputs(const EntryInfo& entry, const Batch& batch, uint64_t row) {
  const void* const* column = batch.inputs;
  for (const InputInfo& input : entry.inputs) {
    if (input.type == ValueType::Boolean)
      lua_pushboolean(lua_, static_cast<const uint8_t*>(*column)[row]);
    else if (input.type == ValueType::Integer)
      lua_pushinteger(lua_, static_cast<const int64_t*>(*column)[row]);
    else if (input.type == ValueType::Number)
      lua_pushnumber(lua_, static_cast<const double*>(*column)[row]);
    else {
      double* components = push_new_vector(lua_, component_count(input.type));
      for (unsigned i = 0; i < component_count(input.type); ++i)
        components[i] = static_cast<const double*>(column[i])[row];
    }
    column += component_count(input.type);
  }
}

FaultCode InterpretState::store_results(const EntryInfo& entry, const Batch& batch, uint64_t row) {
  void* const* column = batch.outputs;
  int at = -int(entry.results.size());
  for (ValueType type : entry.results) {
    if (type == ValueType::Boolean) {
      if (!lua_isboolean(lua_, at)) return wrong_result(at);
      static_cast<uint8_t*>(*column)[row] = uint8_t(lua_toboolean(lua_, at));
    } else if (type == ValueType::Integer) {
      if (!lua_isinteger(lua_, at)) return wrong_result(at);
      static_cast<int64_t*>(*column)[row] = lua_tointeger(lua_, at);
    } else if (type == ValueType::Number) {
      if (lua_type(lua_, at) != LUA_TNUMBER) return wrong_result(at);
      static_cast<double*>(*column)[row] = lua_tonumber(lua_, at);
    } else {
      const std::span<const double> components = vector_at(lua_, at);
      if (components.size() != component_count(type)) return wrong_result(at);
      for (unsigned i = 0; i < component_count(type); ++i)
        static_cast<double*>(column[i])[row] = components[i];
    }
    column += component_count(type);
    ++at;
  }
  return FaultCode::None;
}

/// A result of another type than sema proved: stock Lua went on where the dialect faults (or there is a defect).
FaultCode InterpretState::wrong_result(int at) {
  record_->code = lua_type(lua_, at) == LUA_TNUMBER ? FaultCode::IntegerRange
                  : lua_isnil(lua_, at)             ? FaultCode::Index
                                                    : FaultCode::Error;
  std::snprintf(record_->message, sizeof record_->message, "a result is a %s value", luaL_typename(lua_, at));
  return record_->code;
}

void InterpretState::store_zeros(const EntryInfo& entry, const Batch& batch, uint64_t row) {
  void* const* column = batch.outputs;
  for (ValueType type : entry.results)
    for (unsigned i = 0; i < component_count(type); ++i, ++column) {
      if (type == ValueType::Boolean)
        static_cast<uint8_t*>(*column)[row] = 0;
      else
        static_cast<uint64_t*>(*column)[row] = 0; // integers and doubles alike
    }
}

} // namespace moonshade
