// One page of HTML that needs no other file and no network: sections of text, tables, pictures and plots.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/help/glossary.h"
#include "apps/frontend/show/page/number_map.h"
#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/show/page/web_part.h"
#include "apps/frontend/table/plot.h"
#include "apps/frontend/table/table.h"

namespace dmpc::apps::html {

/// Names and values.
using Facts = std::vector<std::pair<std::string, std::string>>;

/// A sentence, and what shows it: the id of a plot, or a section's heading.
struct Finding {
  std::string sentence;
  std::string place;
};

/// A document under construction. All texts are shown literally, except code between backticks in paragraphs, cells and notes.
/// Pictures, plots and tables have links that save them. Not thread-safe.
class Page {
 public:
  /// `words`: the glossary; outlives the page.
  explicit Page(std::string title, std::span<const GlossaryEntry> words = glossary());

  /// What was added so far opens the page, beside these sentences and before the table of contents.
  void end_opening(std::vector<Finding> findings);
  /// Begins a section, which the page's table of contents links to.
  void begin_section(const std::string& heading);
  void add_text(const std::string& paragraph);
  /// The conclusion of a section, in one sentence; nothing if it is empty.
  void add_conclusion(const std::string& sentence);
  void add_facts(const Facts& facts);
  /// A text to be selected by one click: a command, a citation.
  void add_code(const std::string& text);
  /// A figure from its `url`, with `attributes` of its element. `description`: alternative text. `save`: a link that saves it.
  void add_figure(const std::string& url, const std::string& attributes, const std::string& description,
                  const std::string& caption, const std::string& save);
  /// An empty element, for a script that finds it by its id.
  void add_place(const std::string& id);
  /// Drawn by the page's script.
  void add_map(const NumberMap& map, const std::string& caption);
  /// A table with title and notes; a long one is folded.
  void add_table(const Table& table);
  /// Drawn by the page's script; adds nothing if there is nothing to see. Its element's id is "plot-" and its name.
  void add_plot(const Plot& plot, const Table& table, const std::string& caption = "");
  /// How to reproduce and cite it: its origin, and the `results` by which another run is recognized as the same.
  void add_origin(const Origin& origin, const Facts& results);

  /// Adds styles and scripts, in order.
  void add_style(const WebPart& style);
  void add_script(const WebPart& script);
  /// Data for scripts, which find it by its id: `json` is a whole JSON text; its strings may contain anything.
  void add_data(const std::string& id, const std::string& json);

  /// The whole document, with the glossary at the end.
  std::string text() const;

 private:
  /// A figure that the page's script draws from its data.
  void add_drawn(const std::string& id, const std::string& title, const std::string& data, const std::string& caption);

  std::string title_;
  std::span<const GlossaryEntry> glossary_;
  std::vector<WebPart> styles_, scripts_;
  std::string data_;  ///< elements for scripts
  std::vector<std::string> headings_;
  std::string opening_, body_;
  std::vector<Finding> findings_;
  std::string words_;  ///< all shown text, without markup
};

}  // namespace dmpc::apps::html
