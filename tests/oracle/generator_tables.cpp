// Tables: shapes, constructors, places inside them to read and write, names for them, loops over them.
#include "tests/oracle/generator_impl.h"

namespace moonshade::oracle {

namespace {

unsigned leaves_of(const Type& type) { return type.shape != nullptr ? type.shape->leaves : bit(type.base); }

} // namespace

const Shape* Generator::add_shape(Shape shape) {
  shape.leaves = shape.is_array() ? leaves_of(shape.element) : 0;
  for (const Shape::Field& field : shape.fields)
    shape.leaves |= leaves_of(field.type);
  shapes_.push_back(std::move(shape));
  return &shapes_.back();
}

/// The program's own: later ones may hold earlier ones.
void Generator::make_shapes() {
  const int count = random_.between(1, 4);
  for (int i = 0; i < count; ++i) {
    const auto part = [&]() -> Type {
      if (!shapes_.empty() && random_.chance(0.35)) return {T::N, &shapes_[random_.below(shapes_.size())]};
      return {any_type()};
    };
    Shape shape;
    if (random_.chance(0.6)) {
      shape.element = part();
      shape.length = random_.between(1, shape.element.shape != nullptr ? 3 : 5);
    } else {
      const int fields = random_.between(1, 3);
      for (int k = 0; k < fields; ++k)
        shape.fields.push_back({fresh("m"), part()});
    }
    add_shape(std::move(shape));
  }
}

// ---- places --------------------------------------------------------------------------------------------------------

std::string Generator::index(int length, const std::string& table, int depth) {
  const std::string count = !table.empty() && random_.chance(0.4) ? "#" + table : std::to_string(length);
  std::vector<const Variable*> bounded;
  for (const Variable& variable : scope_)
    if (variable.bound > 0 && variable.bound <= length) bounded.push_back(&variable);
  if (!bounded.empty() && random_.chance(0.5)) return random_.pick(bounded)->name;
  if (random_.chance(0.35)) return std::to_string(random_.between(1, length));
  if (frames_.empty()) return random_.chance(0.5) ? count : std::to_string(random_.between(1, length));
  if (random_.chance(0.02)) return expression(T::I, 1);                                     // anywhere
  if (random_.chance(0.03)) return expression(T::I, 1) + " % " + count;                     // 0 is none
  if (random_.chance(0.04)) return "(" + expression(T::I, 1) + " % " + count + " + 1) / 1"; // a float
  return expression(T::I, std::min(depth - 1, 1)) + " % " + count + " + 1";
}

std::string Generator::descend(std::string text, const Shape* shape, T type, int depth) {
  bool is_root = true;
  for (Type at{T::N, shape}; at.shape != nullptr; is_root = false) {
    if (at.shape->is_array()) {
      text += "[" + index(at.shape->length, is_root && text.find('(') == text.npos ? text : "", depth) + "]";
      at = at.shape->element;
      continue;
    }
    std::vector<const Shape::Field*> fits;
    for (const Shape::Field& field : at.shape->fields)
      if (leaves_of(field.type) & bit(type)) fits.push_back(&field);
    const Shape::Field& field = *random_.pick(fits);
    text += random_.chance(0.9) ? "." + field.name : "[\"" + field.name + "\"]";
    at = field.type;
  }
  return text;
}

std::string Generator::element(T type, bool write, int depth) {
  std::vector<const TableVariable*> fits;
  for (const TableVariable& table : tables_)
    if ((table.shape->leaves & bit(type)) && (!write || is_writable(table))) fits.push_back(&table);
  if (fits.empty()) return {};
  const TableVariable table = *random_.pick(fits);
  if (write) note_write(table);
  if (!write && depth > 1 && random_.chance(0.05)) {
    const std::string fresh = fresh_table(*table.shape, 1);
    return descend("(" + fresh + ")", table.shape, type, depth);
  }
  return descend(table.name, table.shape, type, depth);
}

void Generator::note_write(const TableVariable& table) {
  note_effect(table.level);
  if (table.parameter >= 0) frames_[static_cast<size_t>(table.level) - 1].mutated.insert(table.parameter);
}

// ---- constructors --------------------------------------------------------------------------------------------------

/// `refers`: fields of a record may name tables of this function that stand nowhere else yet.
std::string Generator::constructor(const Shape& shape, int depth, bool refers) {
  const auto part = [&](const Type& type, bool may_refer) {
    if (type.shape == nullptr) return expression(type.base, depth);
    if (may_refer && random_.chance(0.5))
      for (TableVariable& table : tables_)
        if (table.shape == type.shape && table.is_own && table.level == level()) {
          table.is_own = false;
          return table.name;
        }
    return constructor(*type.shape, depth - 1, may_refer && !type.shape->is_array());
  };
  std::string text = "{ ";
  if (shape.is_array()) {
    for (int i = 0; i < shape.length; ++i)
      text += (i ? ", " : "") + part(shape.element, false);
    return text + " }";
  }
  for (size_t i = 0; i < shape.fields.size(); ++i)
    text += (i ? ", " : "") + shape.fields[i].name + " = " + part(shape.fields[i].type, refers);
  return text + " }";
}

std::string Generator::fresh_table(const Shape& shape, int depth) {
  if (depth > 0 && random_.chance(0.2))
    return "(" + expression(T::B, 1) + " and " + fresh_table(shape, depth - 1) + " or " +
           fresh_table(shape, depth - 1) + ")";
  if (depth > 0 && random_.chance(0.4) && calls_ < kMaxCalls)
    for (const Function& candidate : functions_)
      if (candidate.table == &shape && candidate.results.empty() && can_call(candidate, false)) {
        ++calls_;
        return call_text(Function(candidate), depth);
      }
  return constructor(shape, depth, false);
}

// ---- names ---------------------------------------------------------------------------------------------------------

void Generator::declare_table(int depth) {
  const Shape& shape = shapes_[random_.below(shapes_.size())];
  if (random_.chance(0.2)) return alias_table();
  if (random_.chance(0.15)) return table_in_branches(shape);
  const bool plain = random_.chance(0.5);
  const std::string value = plain ? constructor(shape, depth, true) : fresh_table(shape, depth);
  const std::string name = fresh("t");
  line("local " + name + " = " + value);
  tables_.push_back({name, &shape, level(), true, true});
}

/// A second name for a table or for one inside it.
void Generator::alias_table() {
  if (tables_.empty()) return assign();
  TableVariable alias = random_.pick(tables_);
  std::string value = alias.name;
  while (random_.chance(0.6)) {
    if (alias.shape->is_array()) {
      if (alias.shape->element.shape == nullptr) break;
      value += "[" + std::to_string(random_.between(1, alias.shape->length)) + "]";
      alias.shape = alias.shape->element.shape;
      alias.is_element = true;
    } else {
      const Shape::Field& field = random_.pick(alias.shape->fields);
      if (field.type.shape == nullptr) break;
      value += "." + field.name;
      alias.shape = field.type.shape;
    }
  }
  alias.name = fresh("t");
  alias.is_own = false;
  line("local " + alias.name + " = " + value);
  tables_.push_back(alias);
}

void Generator::table_in_branches(const Shape& shape) {
  const std::string name = fresh("t");
  line("local " + name);
  open("if " + expression(T::B, 2) + " then");
  line(name + " = " + fresh_table(shape, 1));
  if (random_.chance(0.3)) {
    close("elseif " + expression(T::B, 2) + " then");
    ++indent_;
    line(name + " = " + fresh_table(shape, 1));
  }
  close("else");
  ++indent_;
  line(name + " = " + fresh_table(shape, 1));
  close();
  tables_.push_back({name, &shape, level(), true, false});
}

void Generator::swap_elements() {
  for (const TableVariable& table : tables_) {
    if (!is_writable(table) || !table.shape->is_array() || table.shape->length < 2 || table.shape->element.shape)
      continue;
    note_write(table);
    const int first = random_.between(1, table.shape->length - 1);
    const std::string a = table.name + "[" + std::to_string(first) + "]";
    const std::string b = table.name + "[" + std::to_string(first + 1) + "]";
    return line(a + ", " + b + " = " + b + ", " + a);
  }
  assign();
}

/// By ipairs or by index; the body reads and writes at the place, and elsewhere.
void Generator::loop_over_table(int depth) {
  std::vector<TableVariable> arrays;
  for (const TableVariable& table : tables_)
    if (table.shape->is_array()) arrays.push_back(table);
  if (arrays.empty()) return declare_table(depth);
  const TableVariable table = random_.pick(arrays);
  const Mark before = mark();
  const std::string i = fresh("i");
  scope_.push_back({i, T::I, false, level(), table.shape->length});
  const Type element = table.shape->element;
  if (random_.chance(0.55)) {
    const std::string value = fresh("e");
    open("for " + i + ", " + value + " in ipairs(" + table.name + ") do");
    if (element.shape != nullptr) {
      tables_.push_back({value, element.shape, table.level, table.writable, false, table.parameter, true});
    } else {
      scope_.push_back({value, element.base, true, level()});
    }
  } else {
    open("for " + i + " = " + (random_.chance(0.6) ? "1, #" + table.name : "#" + table.name + ", 1, -1") + " do");
  }
  if (is_writable(table) && element.shape == nullptr && random_.chance(0.6)) {
    note_write(table);
    line(table.name + "[" + i + "] = " + expression(element.base, 2));
  }
  loop_body(depth - 1);
  leave(before);
  close();
}

} // namespace moonshade::oracle
