// Parsing, checking and printing the stages of one shader (frontend.h).
#include "runtime/frontend.h"

#include "compiler/codegen/c_interface.h"
#include "compiler/codegen/codegen.h"
#include "compiler/codegen/remarks.h"
#include "compiler/ir/print.h"
#include "compiler/syntax/ast.h"
#include "runtime/frontend_parts.h"
#include "runtime/gradients.h"
#include "runtime/image_set.h"
#include "runtime/parameters.h"
#include "runtime/stopwatch.h"
#include "stdlib/sums.h"

#include <algorithm>
#include <sstream>

namespace moonshade {

CheckedShader::CheckedShader() : parts_(std::make_unique<Parts>()) {}

CheckedShader::CheckedShader(const std::string& name, const std::string& text, const std::vector<std::string>& entries,
                             const ModuleReader& modules)
    : CheckedShader() {
  parse(name, text);
  if (!ok()) return;
  Stopwatch watch;
  sema::Options options{entries};
  if (modules)
    options.load_module = [&](const std::string& module) -> sema::LoadedModule {
      ModuleText found = modules(module);
      if (!found.error.empty()) return {nullptr, found.error};
      const FileId file = parts_->sources.add(found.path, std::move(found.text));
      syntax::Chunk* chunk = syntax::parse(parts_->sources, file, parts_->arena, parts_->diagnostics);
      parts_->modules.push_back({module, chunk});
      return {chunk, ""};
    };
  options.load_library = [&] {
    const FileId file = parts_->sources.add("moonshade/sums.lua", std::string(library_lua()));
    parts_->library = syntax::parse(parts_->sources, file, parts_->arena, parts_->diagnostics);
    return parts_->library;
  };
  parts_->program = sema::check(*parts_->chunk, options, parts_->diagnostics);
  for (ImageInfo& image : parts_->program.info.images) {
    const LineColumn place = parts_->sources.position(image.span.file, image.span.begin);
    image.from = parts_->sources.name(image.span.file);
    image.line = place.line;
    image.column = place.column;
  }
  parts_->sema_milliseconds = watch.lap();
}

void CheckedShader::check_images(const ImageOpener& opener) {
  if (!ok()) return;
  for (const ImageInfo& image : parts_->program.info.images) {
    if (image.parameter) continue; // what it names shows when it has a value
    const OpenedImage opened = opener(image.file, image.from, image.raw);
    if (opened.image == nullptr)
      parts_->diagnostics.report(DiagnosticCode::ImageNotFound, image.span, {image.file, opened.error});
  }
}

CheckedShader CheckedShader::parsed(const std::string& name, const std::string& text) {
  CheckedShader shader;
  shader.parse(name, text);
  return shader;
}

void CheckedShader::parse(const std::string& name, const std::string& text) {
  Stopwatch watch;
  const FileId file = parts_->sources.add(name, text);
  parts_->chunk = syntax::parse(parts_->sources, file, parts_->arena, parts_->diagnostics);
  parts_->parse_milliseconds = watch.lap();
}

CheckedShader::~CheckedShader() = default;
CheckedShader::CheckedShader(CheckedShader&&) noexcept = default;
CheckedShader& CheckedShader::operator=(CheckedShader&&) noexcept = default;

bool CheckedShader::ok() const { return !parts_->diagnostics.has_errors(); }
const ShaderInfo& CheckedShader::info() const { return parts_->program.info; }
const Diagnostics& CheckedShader::diagnostics() const { return parts_->diagnostics; }
const SourceSet& CheckedShader::sources() const { return parts_->sources; }

std::vector<std::string> CheckedShader::files() const {
  std::vector<std::string> files;
  for (FileId file = 0; file < parts_->sources.size(); ++file)
    if (parts_->library == nullptr || parts_->library->file != file) files.emplace_back(parts_->sources.name(file));
  return files;
}

CompileTimes CheckedShader::times() const {
  CompileTimes times;
  times.parse = parts_->parse_milliseconds;
  times.sema = parts_->sema_milliseconds;
  times.total = times.parse + times.sema;
  return times;
}

ir::Module build_module(const CheckedShader& shader, const CompileOptions& options) {
  ir::Module module = build_printing_module(shader, options);
  ir::remove_prints(module);
  if (std::string error = optimize_module(module, shader.info(), options); !error.empty())
    module.problems.push_back(std::move(error));
  return module;
}

std::string optimize_module(ir::Module& module, const ShaderInfo& info, const CompileOptions& options) {
  std::vector<Constant> values;
  if (options.bake)
    if (std::string error = parameter_values(info, options.baked, values); !error.empty()) return error;
  // At every level: which products and sums become one operation is part of what f32 means.
  ir::optimize(module, options.precision);
  if (!options.bake) return {};
  for (size_t i = 0; i < values.size(); ++i)
    values[i] = stored_value(info.parameters[i], values[i]);
  ir::bake_parameters(module, values);
  return {};
}

ir::Module build_printing_module(const CheckedShader& shader, const CompileOptions& options) {
  ir::Module module = ir::build(shader.parts().program, {options.step_limit});
  add_gradients(module, shader.info(), options);
  if (!options.entries.empty())
    std::erase_if(module.entries, [&](const ir::Entry& entry) {
      return shader.info().find_entry(entry.name) != nullptr &&
             std::ranges::find(options.entries, entry.name) == options.entries.end();
    });
  return module;
}

codegen::Options codegen_options(const CompileOptions& options) {
  return {options.precision, options.width, options.optimization, options.cpu, options.target, options.uniform_inputs};
}

codegen::Options jit_options(const CompileOptions& options) {
  codegen::Options result = codegen_options(options);
  using codegen::LibraryCalls;
  result.library_calls = options.optimization > 2   ? LibraryCalls::None
                         : options.optimization > 1 ? LibraryCalls::Large
                                                    : LibraryCalls::All;
  return result;
}

void make_quick(codegen::Options& options) {
  // One register a value: two take half as long again to compile.
  if (options.width == 0 && options.cpu == "native" && options.triple.empty())
    options.width = codegen::native_width(options.precision);
  options.optimization = 0;
  options.library_calls = codegen::LibraryCalls::All;
}

FaultSite resolve(const SourceSet& sources, const codegen::FaultPlaceInfo& place) {
  if (!place.span.has_place()) return {"", 0, 0, place.message};
  const LineColumn position = sources.position(place.span.file, place.span.begin);
  return {std::string(sources.name(place.span.file)), position.line, position.column, place.message};
}

ShaderInfo compiled_info(const ShaderInfo& info, const ir::Module& module, const CompileOptions& options) {
  ShaderInfo compiled = info;
  compiled.entries.clear();
  if (options.bake) {
    for (ImageInfo& image : compiled.images) {
      if (!image.parameter) continue;
      const ParameterInfo& parameter = info.parameters[*image.parameter];
      const auto given = options.baked.find(parameter.name);
      image.file = std::get<std::string>(given != options.baked.end() ? given->second : parameter.default_value);
      image.parameter.reset();
    }
    compiled.parameters.clear();
  }
  for (const ir::Entry& entry : module.entries)
    compiled.entries.push_back(entry_info(entry.name, info, options));
  return compiled;
}

namespace {

codegen::CInterface make_c_interface(const CheckedShader& shader, const ir::Module& module,
                                     const codegen::CodeInfo& code, const CompileOptions& options,
                                     const std::string& prefix) {
  std::vector<codegen::CSite> sites;
  for (const codegen::FaultPlaceInfo& place : code.places) {
    FaultSite site = resolve(shader.sources(), place);
    sites.push_back({std::move(site.file), site.line, site.column, place.code, std::move(site.message)});
  }
  return codegen::c_interface(std::string(shader.sources().name(FileId{0})), prefix,
                              compiled_info(shader.info(), module, options), module, code, std::move(sites));
}

} // namespace

namespace {

/// The text of a stage behind the IR; times of emission and optimisation are those of `generated`.
std::string generated_bytes(const CheckedShader& shader, const ir::Module& module, Stage stage,
                            const CompileOptions& options, const std::string& prefix, codegen::Generated& generated) {
  if (stage == Stage::Llvm) return generated.llvm_text();
  if (stage == Stage::Assembly) return generated.assembly();
  const codegen::CInterface interface = make_c_interface(shader, module, generated.info, options, prefix);
  return stage == Stage::Object ? generated.c_object(interface)
                                : codegen::c_header(interface, generated.info, version());
}

} // namespace

std::string refusal(const CheckedShader& shader, const codegen::Generated& generated, bool color) {
  if (generated.exceeded_limit == 0) return "error: " + generated.error + "\n";
  Diagnostics diagnostics;
  diagnostics.report(DiagnosticCode::TooLarge, Span{FileId{0}, 0, 0},
                     {generated.error, std::to_string(generated.exceeded_limit)});
  std::ostringstream text;
  print_text(diagnostics, shader.sources(), text, color);
  return text.str();
}

Emission emit(const CheckedShader& shader, Stage stage, const CompileOptions& options, const std::string& prefix) {
  Emission emission;
  emission.times = shader.times();
  if (stage == Stage::Ast) {
    std::ostringstream text;
    syntax::print_ast(*shader.parts().chunk, text);
    emission.bytes = text.str();
    return emission;
  }
  if (!shader.ok()) {
    emission.error = "the shader has errors";
    return emission;
  }
  if ((stage == Stage::Object || stage == Stage::Header) && !shader.info().images.empty()) {
    const ImageInfo& image = shader.info().images.front();
    emission.error = describe_image_error(image, image.file, "an object has no host that opens images");
    return emission;
  }
  Stopwatch watch;
  const ir::Module module = build_module(shader, options);
  emission.times.ir = watch.lap();
  if (stage == Stage::Ir) {
    emission.bytes = ir::to_text(module);
  } else {
    codegen::Generated generated = codegen::generate(module, codegen_options(options));
    emission.times.emit = generated.times.emit;
    emission.times.optimize = generated.times.optimize;
    watch.lap();
    if (generated.error.empty()) emission.bytes = generated_bytes(shader, module, stage, options, prefix, generated);
    emission.times.codegen = watch.lap();
    emission.is_too_large = generated.exceeded_limit != 0;
    if (!generated.error.empty())
      emission.error = emission.is_too_large ? refusal(shader, generated, options.color_diagnostics) : generated.error;
  }
  emission.times.total += emission.times.ir + emission.times.emit + emission.times.optimize + emission.times.codegen;
  return emission;
}

std::string report_remarks(const CheckedShader& shader, const CompileOptions& options, Diagnostics& diagnostics) {
  return codegen::report_remarks(build_module(shader, options), codegen_options(options), diagnostics);
}

} // namespace moonshade
