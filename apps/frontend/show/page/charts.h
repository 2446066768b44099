// Charts of tables within a page: SVG by gnuplot, in the reader's light or dark mode.
#pragma once

#include <iosfwd>
#include <set>
#include <string>

#include "apps/frontend/system/scratch_folder.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// Draws one chart after the other. Not thread-safe.
class Charts {
 public:
  /// Charts that cannot be drawn are reported to `complaints`, which outlives this, each reason once, in the name of `speaker`: a
  /// chart is optional. `program` is searched as draw() does.
  explicit Charts(std::ostream& complaints, std::string speaker = "dmpc", std::string program = "gnuplot");

  /// The plot as a data URL, light or dark as the page is; empty if there is nothing to show, or it cannot be drawn. Throws
  /// core::InputError if no temporary file can be written.
  std::string draw(Plot plot, const Table& table);

 private:
  void report(const std::string& sentence);

  std::ostream& complaints_;
  std::string speaker_, program_;
  std::set<std::string> reported_;
  ScratchFolder folder_;
};

/// gnuplot's SVG with a style in front: no background, and black on white becomes light on dark in a dark page.
std::string themed(std::string svg);

}  // namespace dmpc::apps::html
