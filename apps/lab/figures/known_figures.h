// The known figures: those that the built-in stats.schema.json allows in a render's --stats.
#pragma once

#include <string>
#include <vector>

namespace dmpc::apps {

struct KnownFigure {
  std::string name;  ///< as in Figure; "*" for any index of a list: "nodes.*.pages.faults"
  bool is_number = false;
};

/// Returns them in the order of the file.
const std::vector<KnownFigure>& known_figures();

/// Returns whether this is the name of a figure that is a number if present.
bool is_number(const std::string& name);

/// Returns the figure meant by a name, its last words or what it is the total of: "pages.faults", "faults", "virtual_seconds".
/// Figures of all nodes together take precedence over those of one. Throws core::UsageError, with `option` before the word, if
/// there is none or there are several.
std::string figure_meant(const std::string& typed, const std::string& option);

}  // namespace dmpc::apps
