// Pictures of tables within a page: SVG by gnuplot, in the reader's light or dark.
#pragma once

#include <iosfwd>
#include <set>
#include <string>

#include "apps/frontend/system/scratch_folder.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// Draws one after the other. Not thread-safe.
class Charts {
 public:
  /// What cannot be drawn is told to `complaints`, which outlives this, each reason once, as what `speaker` says: a picture is an
  /// extra. `program` is looked for as draw() does.
  explicit Charts(std::ostream& complaints, std::string speaker = "dmpc", std::string program = "gnuplot");

  /// The plot within its own address, light or dark as the page is; empty if there is nothing to show, or it cannot be drawn.
  /// Throws core::InputError if no temporary file can be written.
  std::string draw(Plot plot, const Table& table);

 private:
  void report(const std::string& sentence);

  std::ostream& complaints_;
  std::string speaker_, program_;
  std::set<std::string> reported_;
  ScratchFolder folder_;
};

/// gnuplot's SVG with a style of its own in front: no background, and what is black on white is light on dark where the reader's
/// page is.
std::string themed(std::string svg);

}  // namespace dmpc::apps::html
