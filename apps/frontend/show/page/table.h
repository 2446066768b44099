// A table for people: in units of a size that suits its numbers, with a link to save its data.
#pragma once

#include <string>

#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// The element <table>: headings, rows and, if asked for, its title. Columns counted in one unit are shown in a common unit; if a
/// column's numbers differ too much for that, each cell has its unit.
std::string table_element(const Table& table, bool has_caption);

/// All words in the table.
std::string words_of(const Table& table);

/// A link that saves the data at `url` under a name made of `title` and `ending`: "CSV".
std::string save_link(const std::string& title, const std::string& ending, const std::string& url);
/// A save link within a figure, for the figure's content: save.js sets its address; without a script it is hidden.
std::string shown_save_link(const std::string& title, const std::string& ending);

}  // namespace dmpc::apps::html
