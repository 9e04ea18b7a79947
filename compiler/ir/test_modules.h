// For tests: modules of one function, in a few lines.
#pragma once

#include "compiler/ir/builder.h"
#include "compiler/ir/print.h"
#include "compiler/ir/verify.h"

#include <functional>
#include <string>
#include <vector>

namespace moonshade::ir::test {

/// A module with an empty init and the entry `f`, whose body `fill` builds.
inline Module module_of(std::vector<ValueType> parameters, std::vector<ValueType> results,
                        const std::function<void(Builder&)>& fill) {
  Module module;
  module.functions.resize(2);
  module.functions[0].name = "top_level";
  Function& function = module.functions[1];
  function.name = "f";
  for (size_t i = 0; i < parameters.size(); ++i)
    function.parameter_names.push_back(std::string(1, char('a' + i)));
  function.parameters = std::move(parameters);
  function.results = std::move(results);
  {
    Builder builder(function);
    fill(builder);
  }
  module.init = 0;
  module.entries.push_back({"f", 1});
  return module;
}

/// The text of `f`, and its rules kept.
inline std::string text_of(const Module& module) {
  std::string text = "\n" + to_text(module, module.functions.back());
  for (const std::string& violation : verify(module))
    text += violation + "\n";
  return text;
}

} // namespace moonshade::ir::test
