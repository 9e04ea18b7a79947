// What executing a block in vain would cost: for the choice between `if` and `select`.
#pragma once

#include "compiler/ir/ir.h"

#include <optional>

namespace moonshade::ir {

/// Ifs whose sides cost at most this much together are better as selects: a branch over varying lanes runs both sides
/// anyway, and a well predicted branch saves little more.
inline constexpr unsigned kSelectCost = 12;

/// The cost of one instruction in about additions; nothing where it may not be executed in vain (it has an effect,
/// reads what changes, or is a call).
std::optional<unsigned> speculation_cost(const Instruction& instruction);
/// The same of all instructions of a block.
std::optional<unsigned> speculation_cost(const Function& function, const Block& block);

} // namespace moonshade::ir
