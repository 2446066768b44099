// Compares the figures of two runs.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/figures/figures_file.h"

namespace dmpc::apps {

/// Numbers at a key, as is_within() takes it, count as equal if they differ by no more than this share of the reference's.
struct Tolerance {
  std::string key;
  double share = 0;
};

/// Parses "pages.faults:0.05": a key, a colon and a number from 0 on. Throws core::UsageError for anything else.
Tolerance parse_tolerance(const std::string& text);

/// The figures to compare. Those that depend on the clock of this computer (seconds, heat maps of processor time), dmpc's version
/// and names of files are left out unless a tolerance names them.
struct FigureChoice {
  std::vector<std::string> only;  ///< keys; none: all figures
  std::vector<Tolerance> tolerances;
};

/// A value is nothing if its file has no such figure.
struct Difference {
  std::string name;
  std::optional<FigureValue> figure, reference;
};

struct FigureComparison {
  std::size_t compared = 0;  ///< figures that at least one file has
  std::vector<Difference> differences;
};

/// Figures are in the order of the reference, followed by those that it does not have. Throws core::InputError for a key at which
/// neither has a figure.
FigureComparison compare_figures(std::span<const Figure> figures, std::span<const Figure> reference, const FigureChoice& choice);

}  // namespace dmpc::apps
