#include "apps/html/page.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <variant>

#include "apps/figures.h"
#include "apps/html/data_url.h"
#include "apps/html/escaped.h"
#include "apps/html/style.h"

namespace dmpc::apps::html {

namespace {

/// Tables with more are folded.
constexpr std::size_t open_rows_max = 16;

std::string element(const std::string& name, const std::string& text) {
  return "<" + name + ">" + escaped(text) + "</" + name + ">\n";
}

struct CellText {
  int digits;

  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(const std::string& text) const { return escaped(text); }
  std::string operator()(std::uint64_t number) const { return grouped(number); }
  std::string operator()(double number) const { return fixed(number, digits); }
};

bool is_of_text(const Table& table, std::size_t column) {
  return std::any_of(table.rows().begin(), table.rows().end(),
                     [&](const auto& row) { return std::holds_alternative<std::string>(row[column]); });
}

std::string heads_of(const Table& table) {
  std::string heads;
  for (std::size_t i = 0; i < table.columns().size(); ++i) {
    heads += (is_of_text(table, i) ? "<th scope=\"col\" class=\"text\">" : "<th scope=\"col\">") +
             escaped(header_of(table.columns()[i])) + "</th>";
  }
  return "<tr>" + heads + "</tr>\n";
}

std::string rows_of(const Table& table) {
  std::string text;
  for (const std::vector<Cell>& row : table.rows()) {
    text += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      text += (std::holds_alternative<std::string>(row[i]) ? "<td class=\"text\">" : "<td>") +
              std::visit(CellText{table.columns()[i].digits}, row[i]) + "</td>";
    }
    text += "</tr>\n";
  }
  return text;
}

std::string notes_of(const Table& table) {
  std::string text;
  for (const std::string& note : table.notes()) {
    text += element("li", note);
  }
  return text.empty() ? "" : "<ul class=\"notes\">\n" + text + "</ul>\n";
}

std::string id_of(std::size_t section) { return "s" + std::to_string(section); }

}  // namespace

Page::Page(std::string title, std::ostream& complaints) : title_(std::move(title)), charts_(complaints) {}

void Page::begin_section(const std::string& heading) {
  headings_.push_back(heading);
  body_ += "<h2 id=\"" + id_of(headings_.size()) + "\">" + escaped(heading) + "</h2>\n";
}

void Page::add_text(const std::string& paragraph) { body_ += element("p", paragraph); }

void Page::add_facts(const Facts& facts) {
  body_ += "<dl>\n";
  for (const auto& [name, text] : facts) {
    body_ += "<div>" + element("dt", name) + element("dd", text) + "</div>\n";
  }
  body_ += "</dl>\n";
}

void Page::add_picture(const Image& image, const std::string& description, const std::string& caption, PictureSize size) {
  const Image shown = shrunk(image, picture_side_max);
  const bool is_shrunk = shown.width != image.width;
  add_figure(data_url(shown),
             "class=\"" + std::string(size == PictureSize::wide ? "squares" : "picture") + "\" width=\"" +
                 std::to_string(shown.width) + "\" height=\"" + std::to_string(shown.height) + "\"",
             description,
             caption + (is_shrunk ? " Shown smaller than it is: " + std::to_string(image.width) + "x" +
                                        std::to_string(image.height) + " pixels."
                                  : ""));
}

void Page::add_table(const Table& table) {
  const std::size_t count = table.rows().size();
  const bool is_folded = count > open_rows_max;
  body_ += is_folded ? "<details>\n<summary>" + escaped(table.title()) + " (" + counted(count, "row") + ")</summary>\n" : "";
  body_ += "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"" + escaped(table.title()) + "\">\n<table>\n";
  body_ += is_folded ? "" : "<caption>" + escaped(table.title()) + "</caption>\n";
  body_ +=
      "<thead>" + heads_of(table) + "</thead>\n<tbody>\n" + rows_of(table) + "</tbody>\n</table>\n</div>\n" + notes_of(table);
  body_ += is_folded ? "</details>\n" : "";
}

void Page::add_plot(const Plot& plot, const Table& table) {
  if (const std::string url = charts_.url_of(plot, table); !url.empty()) {
    add_figure(url, "class=\"plot\"", "Plot: " + plot.title, "");
  }
}

void Page::add_figure(const std::string& url, const std::string& attributes, const std::string& description,
                      const std::string& caption) {
  body_ += "<figure><img " + attributes + " alt=\"" + escaped(description) + "\" src=\"" + url + "\">" +
           (caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>") + "</figure>\n";
}

std::string Page::text() const {
  std::string contents;
  for (std::size_t i = 0; i < headings_.size(); ++i) {
    contents += "<a href=\"#" + id_of(i + 1) + "\">" + escaped(headings_[i]) + "</a>\n";
  }
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
         escaped(title_) + "</title>\n<style>\n" + style + "</style>\n</head>\n<body>\n<main>\n<h1>" + escaped(title_) +
         "</h1>\n" + (contents.empty() ? "" : "<nav aria-label=\"Contents\">\n" + contents + "</nav>\n") + body_ +
         "</main>\n</body>\n</html>\n";
}

Image shrunk(const Image& image, int side_max) {
  const int step = (std::max(image.width, image.height) + side_max - 1) / side_max;
  if (step <= 1) {
    return image;
  }
  const auto at = [](const Image& of, int x, int y) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(of.width) + static_cast<std::size_t>(x)) * 3;
  };
  Image small((image.width + step - 1) / step, (image.height + step - 1) / step);
  std::vector<float> count(small.rgb.size());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t from = at(image, x, y), to = at(small, x / step, y / step);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        small.rgb[to + channel] += image.rgb[from + channel];
        count[to + channel] += 1;
      }
    }
  }
  std::transform(small.rgb.begin(), small.rgb.end(), count.begin(), small.rgb.begin(), std::divides());
  return small;
}

}  // namespace dmpc::apps::html
