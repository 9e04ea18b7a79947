// Batches of points for one entry: owns the arrays that a Batch points to, in the representation that a shader wants.
#pragma once

#include "runtime/shader.h"
#include "tools/support/values.h"

#include <cstddef>
#include <string>
#include <vector>

namespace moonshade::tools {

/// One array for each component of each input and result of `entry`, all of `capacity` elements.
class Points {
public:
  Points(const EntryInfo& entry, Precision precision, size_t capacity);

  size_t capacity() const { return capacity_; }
  Precision precision() const { return precision_; }
  size_t input_count() const { return inputs_.size(); }   ///< components of inputs
  size_t output_count() const { return outputs_.size(); } ///< components of results
  ValueType input_type(size_t component) const { return inputs_[component].type; }
  ValueType output_type(size_t component) const { return outputs_[component].type; }

  void set_input(size_t component, size_t row, Scalar value);
  Scalar input(size_t component, size_t row) const;
  Scalar output(size_t component, size_t row) const;
  FaultCode fault(size_t row) const { return FaultCode(fault_codes_[row]); }

  /// Shades rows 0 .. count - 1.
  FaultReport run(const Shader& shader, size_t entry, size_t count);
  /// Shades rows begin .. begin + count - 1; calls for separate rows may run at once.
  FaultReport run_range(const Shader& shader, size_t entry, size_t begin, size_t count);

  /// What a row prints, line by line.
  void print(const Shader& shader, size_t entry, size_t row, const PrintSink& sink) const;

  /// Appends "fault: KIND" or the results of a row, separated by ", ".
  void append_row(std::string& out, size_t row) const;

private:
  struct Column {
    ValueType type;
    size_t element_size;
    std::vector<std::byte> bytes;
  };
  Column make_column(ValueType type) const;
  Scalar read(const Column& column, size_t row) const;

  Precision precision_;
  size_t capacity_;
  std::vector<Column> inputs_, outputs_;
  std::vector<uint8_t> fault_codes_;
};

/// "p = 1, 2, 3; time = 0": the inputs of a row, for messages.
std::string describe_inputs(const EntryInfo& entry, const Points& points, size_t row);

} // namespace moonshade::tools
