// Pictures of tables within a page: SVG by gnuplot, in the reader's light or dark.
#pragma once

#include <iosfwd>
#include <set>
#include <string>

#include "apps/edge/system/scratch_folder.h"
#include "apps/edge/table/plot.h"
#include "apps/edge/table/table.h"

namespace dmpc::apps::html {

/// A plot as URLs of its own bytes; empty if it has nothing to show, or cannot be drawn.
struct Chart {
  std::string url;          ///< to be shown in a page, light or dark as that is
  std::string url_to_save;  ///< to be shown by itself, dark on white
};

/// Draws one after the other. Not thread-safe.
class Charts {
 public:
  /// What cannot be drawn is told to `complaints`, which outlives this, each reason once, as what `speaker` says: a picture is an
  /// extra. `program` is looked for as draw() does.
  explicit Charts(std::ostream& complaints, std::string speaker = "dmpc", std::string program = "gnuplot");

  /// Throws core::InputError if no temporary file can be written.
  Chart draw(Plot plot, const Table& table);

 private:
  std::ostream& complaints_;
  std::string speaker_, program_;
  std::set<std::string> told_;
  ScratchFolder folder_;
};

/// gnuplot's SVG with a style of its own in front: no background, and what is black on white is light on dark where the reader's
/// page is.
std::string themed(std::string svg);

}  // namespace dmpc::apps::html
