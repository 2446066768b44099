// What figures there are: what stats.schema.json, which is built in, allows in what a render's --stats writes.
#pragma once

#include <string>
#include <vector>

namespace dmpc::apps {

struct KnownFigure {
  std::string name;  ///< as Figure has it; "*" for any place in a list: "nodes.*.pages.faults"
  bool is_number = false;
};

/// In the order of the file.
const std::vector<KnownFigure>& known_figures();

/// Whether this is the name of one that is a number, where it is there.
bool is_number(const std::string& name);

/// The one that somebody means who types its name, its last words or what it is the total of: "pages.faults", "faults",
/// "virtual_seconds". Figures of all nodes together come before those of one. Throws core::UsageError, with `option` before the
/// word, if there is none or there are several.
std::string figure_meant(const std::string& typed, const std::string& option);

}  // namespace dmpc::apps
