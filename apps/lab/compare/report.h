// What `compare` prints: figures of two pictures, or the counters in which two runs differ.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "apps/lab/compare/differences.h"
#include "apps/lab/difference/picture_error.h"

namespace dmpc::apps {

/// The files, as they were typed.
struct ComparedFiles {
  std::filesystem::path a, reference;
};

/// A line each figure.
void print_text(std::ostream& output, const ComparedFiles& files, const PictureError& error);
/// One object, in which what is infinite is null; `passed` are limits of --fail-above.
void print_json(std::ostream& output, const ComparedFiles& files, const PictureError& error,
                const std::vector<std::string>& passed);

/// A line each difference, a hundred at most, and how many there are.
void print_text(std::ostream& output, const ComparedFiles& files, const FigureComparison& comparison);
/// One object with all differences; a figure that a file does not have is not there.
void print_json(std::ostream& output, const ComparedFiles& files, const FigureComparison& comparison);

}  // namespace dmpc::apps
