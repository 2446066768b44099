// One page of HTML that needs no other file and no network: sections of text, tables, pictures and plots.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/picture/image_file.h"
#include "apps/show/page/charts.h"
#include "apps/show/page/number_map.h"
#include "apps/show/page/origin.h"
#include "apps/table/plot.h"
#include "apps/table/table.h"

namespace dmpc::apps::html {

/// Names and what they are.
using Facts = std::vector<std::pair<std::string, std::string>>;

/// A document under way. All texts are shown as they are, whatever they contain, but for code between backticks in paragraphs,
/// cells and notes. Pictures, plots and tables have links that save them. Not thread-safe.
class Page {
 public:
  /// `complaints`: as Charts.
  Page(std::string title, std::ostream& complaints);

  /// What follows belongs to it, and the page's list of contents leads there.
  void begin_section(const std::string& heading);
  void add_text(const std::string& paragraph);
  /// What a section comes to, in one sentence; nothing if it is empty.
  void add_conclusion(const std::string& sentence);
  void add_facts(const Facts& facts);
  /// To be selected whole by one click: a command, a citation.
  void add_code(const std::string& text);
  /// `description`: for those who do not see it. Larger pictures than picture_side_max a side are shrunk, and the page says so;
  /// the link saves them whole.
  void add_picture(const Image& image, const std::string& description, const std::string& caption);
  void add_map(const NumberMap& map, const std::string& caption);
  /// With title and notes; a long one is folded.
  void add_table(const Table& table);
  /// Nothing if there is nothing to see, or no program to draw it.
  void add_plot(const Plot& plot, const Table& table);
  /// How to make it again, and what to cite: where it comes from, and the `results` by which another run is known to be the same.
  void add_origin(const Origin& origin, const Facts& results);

  /// The whole document, with what its words mean at the end.
  std::string text() const;

 private:
  void add_figure(const std::string& url, const std::string& attributes, const std::string& description,
                  const std::string& caption, const std::string& save);

  std::string title_;
  Charts charts_;
  std::vector<std::string> headings_;
  std::string body_;
  std::string words_;  ///< all that is shown, without markup
};

/// Pixels.
inline constexpr int picture_side_max = 1024;

/// Each pixel the mean of a square of them, so that neither side is longer than `side_max`.
Image shrunk(const Image& image, int side_max);

}  // namespace dmpc::apps::html
