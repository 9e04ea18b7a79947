// The fields of all that an entry of the cache holds (program_archive.h, archive.h).
#include "runtime/program_archive.h"

#include "runtime/archive.h"

namespace moonshade {

template <> constexpr ValueType last_value() { return ValueType::Mat4; }
template <> constexpr FaultCode last_value() { return FaultCode::IntegerRange; }
template <> constexpr Precision last_value() { return Precision::F64; }

template <class A> void fields(A& archive, Span& value) {
  auto& [file, begin, end] = value;
  archive(file, begin, end);
}
template <class A> void fields(A& archive, InputInfo& value) {
  auto& [name, type] = value;
  archive(name, type);
}
template <class A> void fields(A& archive, EntryInfo& value) {
  auto& [name, inputs, results] = value;
  archive(name, inputs, results);
}
template <class A> void fields(A& archive, ParameterInfo& value) {
  auto& [name, span, type, default_value, min, max, step, doc, label, choices, compared] = value;
  archive(name, span, type, default_value, min, max, step, doc, label, choices, compared);
}
template <class A> void fields(A& archive, ImageInfo& value) {
  auto& [file, parameter, raw, span, from, line, column] = value;
  archive(file, parameter, raw, span, from, line, column);
}
template <class A> void fields(A& archive, ShaderInfo& value) {
  auto& [entries, parameters, modules, images] = value;
  archive(entries, parameters, modules, images);
}
template <class A> void fields(A& archive, ParameterSlot& value) {
  auto& [parameter, type, offset] = value;
  archive(parameter, type, offset);
}
template <class A> void fields(A& archive, FaultSite& value) {
  auto& [file, line, column, message] = value;
  archive(file, line, column, message);
}

namespace codegen {

template <class A> void fields(A& archive, Component& value) {
  auto& [size, uniform] = value;
  archive(size, uniform);
}
template <class A> void fields(A& archive, KernelInfo& value) {
  auto& [width, inputs, outputs, site_codes] = value;
  archive(width, inputs, outputs, site_codes);
}
template <class A> void fields(A& archive, EntryCode& value) {
  auto& [symbol, info] = value;
  archive(symbol, info);
}
template <class A> void fields(A& archive, FaultPlaceInfo& value) {
  auto& [code, span, message] = value;
  archive(code, span, message);
}
template <class A> void fields(A& archive, PrintPlaceInfo& value) {
  auto& [text, types] = value;
  archive(text, types);
}
template <class A> void fields(A& archive, CodeInfo& value) {
  auto& [precision, width, entries, init_symbol, global_offsets, constants_size, places, prints, print_slot,
         image_slot] = value;
  archive(precision, width, entries, init_symbol, global_offsets, constants_size, places, prints, print_slot,
          image_slot);
}

} // namespace codegen

template <class A> void fields(A& archive, ArchivedProgram& value) {
  auto& [info, code, slots, sites, has_prints, diagnostics, object] = value;
  archive(info, code, slots, sites, has_prints, diagnostics, object);
}

namespace {

/// What the runtime relies on when it uses one list by the indices of another.
bool fits_together(const ArchivedProgram& program) {
  const codegen::CodeInfo& code = program.code;
  if (code.entries.size() != program.info.entries.size() || code.places.size() != program.sites.size()) return false;
  for (const codegen::EntryCode& entry : code.entries) {
    if (entry.info.width != code.width || entry.info.site_codes.size() != code.places.size()) return false;
    for (const auto* components : {&entry.info.inputs, &entry.info.outputs})
      for (const codegen::Component& component : *components)
        if (component.size > sizeof(uint64_t)) return false;
  }
  for (const ImageInfo& image : program.info.images) {
    if (!image.parameter) continue;
    if (*image.parameter >= program.info.parameters.size()) return false;
    const Constant& file = program.info.parameters[*image.parameter].default_value;
    if (!std::holds_alternative<std::string>(file)) return false;
  }
  if (code.print_slot + sizeof(void*) > code.block_size() || code.image_slot + sizeof(void*) > code.block_size())
    return false;
  for (const ParameterSlot& slot : program.slots)
    if (slot.parameter >= program.info.parameters.size() || slot.offset >= code.constants_size) return false;
  return code.width != 0 && code.width <= kWidths.back() && code.constants_size <= uint64_t{1} << 32;
}

} // namespace

std::string to_bytes(const ArchivedProgram& program) {
  ArchiveWriter writer;
  writer(program);
  return writer.bytes();
}

std::optional<ArchivedProgram> archived_program(std::string_view bytes) {
  ArchivedProgram program;
  ArchiveReader reader(bytes);
  reader(program);
  if (!reader.complete() || !fits_together(program)) return std::nullopt;
  return program;
}

} // namespace moonshade
