// Where the figures of two runs differ.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/figures/figures_file.h"

namespace dmpc::apps {

/// Numbers at a key, as is_within() takes it, count as equal when they differ by no more than this share of the reference's.
struct Tolerance {
  std::string key;
  double share = 0;
};

/// "pages.faults:0.05": a key, a colon and a number from 0 on. Throws core::UsageError for anything else.
Tolerance parse_tolerance(const std::string& text);

/// Which figures are compared. What hangs on the clock of this computer is left out (seconds, heat maps of processor time), and
/// so are dmpc's version and names of files, unless a tolerance has them.
struct FigureChoice {
  std::vector<std::string> only;  ///< keys; none: all figures
  std::vector<Tolerance> tolerances;
};

/// Nothing where a file has no such figure.
struct Difference {
  std::string name;
  std::optional<FigureValue> figure, reference;
};

struct FigureComparison {
  std::size_t compared = 0;  ///< figures that at least one file has
  std::vector<Difference> differences;
};

/// In the order of the reference, then what it does not have. Throws core::InputError for a key at which neither has a figure.
FigureComparison compare_figures(std::span<const Figure> figures, std::span<const Figure> reference, const FigureChoice& choice);

}  // namespace dmpc::apps
