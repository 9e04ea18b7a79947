// Programs that are large or deep on purpose, up to a megabyte: each grows in one way.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace moonshade::fuzz {

struct HostileProgram {
  std::string name;
  std::function<std::string()> text;
};

std::vector<HostileProgram> hostile_programs();

} // namespace moonshade::fuzz
