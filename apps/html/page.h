// One page of HTML that needs no other file and no network: sections of text, tables, pictures and plots.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/html/charts.h"
#include "apps/image_file.h"
#include "apps/plot.h"
#include "apps/study_table.h"

namespace dmpc::apps::html {

/// How large a picture is shown.
enum class PictureSize : std::uint8_t {
  own,  ///< a pixel is a pixel, as far as there is room
  wide  ///< as wide as there is room for two, its pixels as squares
};

/// Names and what they are.
using Facts = std::vector<std::pair<std::string, std::string>>;

/// A document under way. All texts are shown as they are, whatever they contain. Not thread-safe.
class Page {
 public:
  /// `complaints`: as Charts.
  Page(std::string title, std::ostream& complaints);

  /// What follows belongs to it, and the page's list of contents leads there.
  void begin_section(const std::string& heading);
  void add_text(const std::string& paragraph);
  void add_facts(const Facts& facts);
  /// `description`: for those who do not see it. Larger pictures than picture_side_max a side are shrunk, and the page says so.
  void add_picture(const Image& image, const std::string& description, const std::string& caption,
                   PictureSize size = PictureSize::own);
  /// With title and notes; a long one is folded.
  void add_table(const Table& table);
  /// Nothing if there is nothing to see, or no program to draw it.
  void add_plot(const Plot& plot, const Table& table);

  /// The whole document.
  std::string text() const;

 private:
  void add_figure(const std::string& url, const std::string& attributes, const std::string& description,
                  const std::string& caption);

  std::string title_;
  Charts charts_;
  std::vector<std::string> headings_;
  std::string body_;
};

/// Pixels.
inline constexpr int picture_side_max = 1024;

/// Each pixel the mean of a square of them, so that neither side is longer than `side_max`.
Image shrunk(const Image& image, int side_max);

}  // namespace dmpc::apps::html
