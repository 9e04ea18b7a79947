// The library's exports for tests: the embedded bitcode, compiled to native code by the build, called through the ABI
// that library.h states.
#pragma once

#include "stdlib/library.h"
#include "stdlib/print_precision_for_test.h"

#include <span>
#include <vector>

namespace moonshade::test {

/// The export of a row of the table or of a derivative, as compiled from its bitcode.
void* export_address(const LibraryFunction& row, Precision precision, unsigned width);

/// Bytes that a lane's component takes in memory.
unsigned component_size(ValueType type, Precision precision);

/// One value of a row for many points: component after component, each all points side by side.
struct Column {
  ValueType type;
  std::vector<unsigned char> bytes;
};

/// Calls a row's export for all points, in blocks of `width` of them; arguments are columns of `points` points, a
/// multiple of 32.
std::vector<Column> run_export(const LibraryFunction& row, Precision precision, unsigned width,
                               std::span<const Column> arguments, unsigned points);

/// True where the machine can run what the build made of the bitcode.
bool exports_can_run();

} // namespace moonshade::test
