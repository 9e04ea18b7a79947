// Batches of points for one entry.
#include "tools/support/points.h"

#include <cstring>

namespace moonshade::tools {

namespace {

size_t element_size(ValueType type, Precision precision) {
  if (type == ValueType::Boolean) return 1;
  if (type == ValueType::Integer) return 8;
  return precision == Precision::F32 ? 4 : 8;
}

template <class T> void put(std::vector<std::byte>& bytes, size_t row, T value) {
  std::memcpy(bytes.data() + row * sizeof(T), &value, sizeof(T));
}

template <class T> T get(const std::vector<std::byte>& bytes, size_t row) {
  T value;
  std::memcpy(&value, bytes.data() + row * sizeof(T), sizeof(T));
  return value;
}

} // namespace

Points::Points(const EntryInfo& entry, Precision precision, size_t capacity)
    : precision_(precision), capacity_(capacity), fault_codes_(capacity) {
  for (const InputInfo& input : entry.inputs)
    for (unsigned i = 0; i < component_count(input.type); ++i)
      inputs_.push_back(make_column(input.type));
  for (ValueType type : entry.results)
    for (unsigned i = 0; i < component_count(type); ++i)
      outputs_.push_back(make_column(type));
}

Points::Column Points::make_column(ValueType type) const {
  const size_t size = element_size(type, precision_);
  return {type, size, std::vector<std::byte>(size * capacity_)};
}

void Points::set_input(size_t component, size_t row, Scalar value) {
  Column& column = inputs_[component];
  if (column.type == ValueType::Boolean)
    put(column.bytes, row, uint8_t(value.boolean));
  else if (column.type == ValueType::Integer)
    put(column.bytes, row, value.integer);
  else if (precision_ == Precision::F32)
    put(column.bytes, row, float(value.number));
  else
    put(column.bytes, row, value.number);
}

Scalar Points::read(const Column& column, size_t row) const {
  Scalar scalar{};
  if (column.type == ValueType::Boolean)
    scalar.boolean = get<uint8_t>(column.bytes, row) != 0;
  else if (column.type == ValueType::Integer)
    scalar.integer = get<int64_t>(column.bytes, row);
  else if (precision_ == Precision::F32)
    scalar.number = double(get<float>(column.bytes, row));
  else
    scalar.number = get<double>(column.bytes, row);
  return scalar;
}

Scalar Points::input(size_t component, size_t row) const { return read(inputs_[component], row); }
Scalar Points::output(size_t component, size_t row) const { return read(outputs_[component], row); }

FaultReport Points::run(const Shader& shader, size_t entry, size_t count) { return run_range(shader, entry, 0, count); }

FaultReport Points::run_range(const Shader& shader, size_t entry, size_t begin, size_t count) {
  std::vector<const void*> inputs;
  std::vector<void*> outputs;
  for (const Column& column : inputs_)
    inputs.push_back(column.bytes.data() + begin * column.element_size);
  for (Column& column : outputs_)
    outputs.push_back(column.bytes.data() + begin * column.element_size);
  FaultReport report;
  Batch batch;
  batch.count = count;
  batch.inputs = inputs.data();
  batch.outputs = outputs.data();
  batch.faults = &report;
  batch.fault_codes = fault_codes_.data() + begin;
  shader.run(entry, batch);
  report.first_point += begin;
  return report;
}

void Points::print(const Shader& shader, size_t entry, size_t row, const PrintSink& sink) const {
  std::vector<const void*> inputs;
  inputs.reserve(inputs_.size());
  for (const Column& column : inputs_)
    inputs.push_back(column.bytes.data());
  Batch batch;
  batch.count = capacity_;
  batch.inputs = inputs.data();
  shader.print(entry, batch, row, sink);
}

void Points::append_row(std::string& out, size_t row) const {
  if (fault(row) != FaultCode::None) {
    out += "fault: ";
    out += fault_name(fault(row));
    return;
  }
  for (size_t i = 0; i < outputs_.size(); ++i) {
    if (i != 0) out += ", ";
    append_scalar(out, outputs_[i].type, output(i, row), precision_);
  }
}

std::string describe_inputs(const EntryInfo& entry, const Points& points, size_t row) {
  std::string text;
  size_t component = 0;
  for (const InputInfo& input : entry.inputs) {
    text += (text.empty() ? "" : "; ") + input.name + " = ";
    for (unsigned i = 0; i < component_count(input.type); ++i, ++component) {
      if (i != 0) text += ", ";
      append_scalar(text, input.type, points.input(component, row), points.precision());
    }
  }
  return text;
}

} // namespace moonshade::tools
