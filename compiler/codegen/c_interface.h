// How a C or C++ program calls a shader that was compiled to an object file: without this library and without LLVM.
// An object holds, for the shader copper.lua with the entry `color`,
//
//     const char *copper_instantiate(copper_instance *, const copper_parameters *);
//     void copper_color(const copper_instance *, const copper_color_batch *);
//     const moonshade_fault_site copper_fault_sites[];
//
// and nothing else that other objects can see; the header declares them and their types. It needs the C library and
// its mathematical functions.
#pragma once

#include "compiler/codegen/codegen.h"
#include "compiler/sema/shader_info.h"

#include <string>
#include <vector>

namespace moonshade::codegen {

/// A place that can fault.
struct CSite {
  std::string file;
  uint32_t line = 0, column = 0;
  FaultCode code{};
  std::string message; ///< of assert and error
};

struct CEntry {
  EntryInfo info;
  std::string symbol;                       ///< "copper_color"
  std::vector<std::string> inputs, outputs; ///< the batch's fields, by component: "p_x", "result_y"
};

struct CParameter {
  ParameterInfo info;
  std::string field;
  uint32_t source = 0, target = 0; ///< as CParameterRow
};

struct CInterface {
  std::string file;   ///< the shader's
  std::string prefix; ///< "copper"
  std::vector<CEntry> entries;
  std::vector<CParameter> parameters; ///< those that have data
  std::vector<CParameter> strings;    ///< those without: strings whose values are fixed
  uint32_t parameters_size = 0, parameters_alignment = 1;
  std::vector<CSite> sites;
};

/// `info`: the shader's facts, its entries in the order of the code's. An empty prefix: from the file's name.
CInterface c_interface(const std::string& file, const std::string& prefix, const ShaderInfo& info,
                       const ir::Module& module, const CodeInfo& code, std::vector<CSite> sites);

/// The text of the header: C99 and C++.
std::string c_header(const CInterface& interface, const CodeInfo& code, const std::string& version);

} // namespace moonshade::codegen
