// The command `compare`: how far two pictures lie apart.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <optional>

#include "apps/command_line.h"
#include "apps/image_file.h"
#include "apps/interrupt.h"

namespace dmpc::apps {

struct CompareOptions {
  std::filesystem::path picture;                    ///< A
  std::filesystem::path reference;                  ///< B
  std::optional<std::filesystem::path> difference;  ///< where the picture |A - B| goes
};

/// Declares them.
void add_options(OptionSet options, CompareOptions& compare);

/// Differences of linear floats over all channels of all pixels. A value that is not finite on one side only, or differently,
/// makes the sums infinite.
struct Difference {
  double root_mean_square = 0;
  double largest = 0;
  double mean_absolute = 0;
  double peak_signal_to_noise_decibels = 0;  ///< for a peak of 1; infinite for equal pictures
  double relative_mean_square = 0;           ///< mean of (a - b)^2 / (b^2 + 0.01), b the reference
  std::uint64_t pixels = 0;
  std::uint64_t differing_pixels = 0;  ///< with any channel that differs at all
};

/// Throws core::InputError if the sizes differ.
Difference measure_difference(const Image& picture, const Image& reference);

/// |a - b| channel by channel. Requires equal sizes.
Image difference_picture(const Image& picture, const Image& reference);

/// Reads both, writes the difference picture if asked for, prints the figures to `output`. A signal ends the process. Returns the
/// exit status 0. Throws core::UsageError if the difference picture would replace one of the two, core::InputError if one cannot
/// be read or something cannot be written, Interrupted if a signal came before.
int compare_command(const CompareOptions& options, Interrupt& interrupt, std::ostream& output);

}  // namespace dmpc::apps
