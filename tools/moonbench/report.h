// Tables, JSON and charts of measurements.
#pragma once

#include "tools/moonbench/measure.h"

#include <string>
#include <vector>

namespace moonshade::moonbench {

/// A table for people, with a line of heads.
std::string table(const std::vector<Row>& rows);
/// The contract's array of objects.
std::string json(const std::vector<Row>& rows);
/// A bar chart as SVG: a group of bars an entry, a logarithmic axis.
std::string plot(const std::vector<Row>& rows);

} // namespace moonshade::moonbench
