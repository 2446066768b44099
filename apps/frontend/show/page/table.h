// A table as people read it: in units of a size that suits its numbers, with its data to save.
#pragma once

#include <string>

#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// The element <table>: heads, rows and, if asked for, its title. Columns counted in one unit share the unit they are shown in;
/// one whose numbers are too far apart for that has a unit in each cell.
std::string table_element(const Table& table, bool has_caption);

/// All words that it shows.
std::string words_of(const Table& table);

/// A link that saves what is at `url` under a name made of `title` and `ending`: "CSV".
std::string save_link(const std::string& title, const std::string& ending, const std::string& url);
/// A save link within a figure, for the figure's content: save.js sets its address; without a script it is hidden.
std::string shown_save_link(const std::string& title, const std::string& ending);

}  // namespace dmpc::apps::html
