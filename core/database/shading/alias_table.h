// Selects one of many in proportion to weights by one look-up.
#pragma once

#include <span>
#include <vector>

#include "core/record/emitter.h"

namespace dmpc::core {

/// The table for these weights, one or more, each above 0 and their sum finite: by M. D. Vose, "A Linear Algorithm for Generating
/// Random Numbers with a Given Distribution", IEEE TSE 17 (9), 1991.
std::vector<EmitterChoice> alias_table(std::span<const double> weights);

/// The probability of each in this table, whose thresholds are rounded.
std::vector<double> chances_of(std::span<const EmitterChoice> table);

}  // namespace dmpc::core
