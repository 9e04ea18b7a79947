// table.def as data.
#include "stdlib/library.h"

#include "stdlib/signature.h"

#include <algorithm>
#include <initializer_list>

namespace moonshade {
namespace {

using namespace stdlib;

enum Trait { Plain, Componentwise };

struct Text {
  std::string_view name, symbol, parameter_names, doc;
};

/// A row from its function's type over one double.
template <class Row>
constexpr LibraryFunction describe(Text text, std::initializer_list<double> defaults, Trait trait) {
  using Type = Signature<typename Row::Type>;
  constexpr auto parameters = Type::template Parameters<ParameterTypes>::value;
  constexpr auto results = ResultTypes<typename Type::Result>::value;
  static_assert(parameters.size() <= LibraryFunction::kMaxParameters && results.size() <= LibraryFunction::kMaxResults);
  LibraryFunction row = {};
  row.name = text.name;
  row.symbol = text.symbol;
  row.parameter_names = text.parameter_names;
  row.doc = text.doc;
  row.parameter_count = parameters.size();
  row.required_count = parameters.size() - defaults.size();
  row.result_count = results.size();
  row.componentwise = trait == Componentwise;
  std::copy(parameters.begin(), parameters.end(), row.parameters.begin());
  std::copy(results.begin(), results.end(), row.results.begin());
  std::copy(defaults.begin(), defaults.end(), row.defaults.begin() + row.required_count);
  return row;
}

#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc) MS_ROW(symbol, function, type)
#include "stdlib/table.def"

#define DEFAULTS(...) {__VA_ARGS__}
#define FUNCTION(name, symbol, function, type, defaults, traits, parameters, doc)                                      \
  describe<Row_##symbol::Of<double>>({name, #symbol, parameters, doc}, defaults, traits),
constexpr LibraryFunction kLibrary[] = {
#include "stdlib/table.def"
};

} // namespace

std::span<const LibraryFunction> library() { return kLibrary; }

std::span<const LibraryFunction> library_overloads(std::string_view name) {
  auto is_it = [name](const LibraryFunction& row) { return row.name == name; };
  auto first = std::find_if(std::begin(kLibrary), std::end(kLibrary), is_it);
  auto last = std::find_if_not(first, std::end(kLibrary), is_it);
  return {first, last};
}

} // namespace moonshade
