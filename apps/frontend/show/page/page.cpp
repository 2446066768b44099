#include "apps/frontend/show/page/page.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/show/page/data_url.h"
#include "apps/frontend/show/page/escaped.h"
#include "apps/frontend/show/page/map_data.h"
#include "apps/frontend/show/page/table.h"
#include "apps/frontend/table/plot_data.h"

namespace dmpc::apps::html {

namespace {

/// Tables with more are folded.
constexpr std::size_t open_rows_max = 16;

std::string element(const std::string& name, const std::string& text) {
  return "<" + name + ">" + escaped_with_code(text) + "</" + name + ">\n";
}

/// Their text to the last byte, as the policy has its digest.
std::string elements(const std::string& name, std::span<const WebPart> parts) {
  std::string text;
  for (const WebPart& part : parts) {
    text += "<" + name + ">" + part.text + "</" + name + ">\n";
  }
  return text;
}

std::string notes_of(const Table& table) {
  const std::string text = joined(table.notes(), "", [&](const std::string& note) { return element("li", note); });
  return text.empty() ? "" : "<ul class=\"notes\">\n" + text + "</ul>\n";
}

std::string id_of(std::size_t section) { return "s" + std::to_string(section); }

std::string heading_of(std::size_t section, const std::string& heading) {
  return "<h2 id=\"" + id_of(section) + "\">" + escaped(heading) + "</h2>\n";
}

/// The sentences as links, without those that are empty.
std::string links_of(std::span<const Finding> findings, std::span<const std::string> headings) {
  return joined(findings, "", [&](const Finding& finding) {
    const auto at = std::find(headings.begin(), headings.end(), finding.place);
    const std::string id = at == headings.end() ? finding.place : id_of(static_cast<std::size_t>(at - headings.begin()) + 1);
    return finding.sentence.empty()
               ? ""
               : "<li><a href=\"#" + escaped(id) + "\">" + escaped_with_code(finding.sentence) + "</a></li>\n";
  });
}

/// What the words of a text mean; empty if it has none of these.
std::string meanings(const std::string& words, std::span<const GlossaryEntry> glossary) {
  std::string list;
  for (const GlossaryEntry& entry : glossary) {
    if (occurs(entry.word, words)) {
      list += "<div>" + element("dt", std::string(entry.word)) + element("dd", std::string(entry.meaning)) + "</div>\n";
    }
  }
  return list.empty() ? "" : "<dl class=\"glossary\">\n" + list + "</dl>\n";
}

std::string data_element(const std::string& attribute, const std::string& json) {
  std::string text = "<script type=\"application/json\" " + attribute + ">";
  for (const char letter : json) {
    text += letter == '<' ? "\\u003c" : std::string(1, letter);  // JSON has it in texts alone
  }
  return text + "</script>";
}

std::string capitalized(std::string text) {
  if (!text.empty()) {
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  }
  return text;
}

/// One sentence with everything that distinguishes this run from others.
std::string citation(const std::string& title, const Origin& origin, const Facts& results) {
  std::string text =
      title + ". " + origin.program.substr(0, origin.program.rfind(" (")) + ", " + origin.date.substr(0, origin.date.find(' '));
  for (const auto& [name, value] : results) {
    text += ", " + name + " " + value;
  }
  return text + ".";
}

}  // namespace

Page::Page(std::string title, std::span<const GlossaryEntry> words)
    : title_(std::move(title)), glossary_(words), styles_({page_style}), scripts_({page_script}), words_(title_) {}

void Page::end_opening(std::vector<Finding> findings) {
  opening_ = std::exchange(body_, "");
  findings_ = std::move(findings);
  for (const Finding& finding : findings_) {
    words_ += "\n" + finding.sentence;
  }
}

void Page::begin_section(const std::string& heading) {
  headings_.push_back(heading);
  body_ += heading_of(headings_.size(), heading);
  words_ += "\n" + heading;
}

void Page::add_text(const std::string& paragraph) {
  body_ += element("p", paragraph);
  words_ += "\n" + paragraph;
}

void Page::add_conclusion(const std::string& sentence) {
  body_ += sentence.empty() ? "" : "<p class=\"conclusion\">" + escaped_with_code(sentence) + "</p>\n";
  words_ += "\n" + sentence;
}

void Page::add_facts(const Facts& facts) {
  body_ += "<dl>\n";
  for (const auto& [name, text] : facts) {
    body_ += "<div><dt>" + escaped(name) + "</dt>\n<dd>" + escaped(text) + "</dd>\n</div>\n";
    words_ += "\n" + name + "\n" + text;
  }
  body_ += "</dl>\n";
}

void Page::add_code(const std::string& text) { body_ += "<pre class=\"copy\">" + escaped(text) + "</pre>\n"; }

void Page::add_place(const std::string& id) { body_ += "<div id=\"" + escaped(id) + "\"></div>\n"; }

void Page::add_map(const NumberMap& map, const std::string& caption) { add_drawn("", map.title, map_data(map), caption); }

void Page::add_table(const Table& table) {
  const std::size_t count = table.rows().size();
  const bool is_folded = count > open_rows_max;
  const bool is_named_before = !headings_.empty() && headings_.back() == table.title();
  body_ += is_folded ? "<details>\n<summary>" + escaped(table.title()) + " (" + counted(count, "row") + ")</summary>\n" : "";
  body_ += "<section class=\"scroll\" tabindex=\"0\" aria-label=\"" + escaped(table.title()) + "\">\n" +
           table_element(table, !is_folded && !is_named_before) + "</section>\n" + notes_of(table) + "<p class=\"saves\">" +
           save_link(table.title(), "CSV", data_url("text/csv", text_of(table, TableFormat::csv))) + "</p>\n";
  body_ += is_folded ? "</details>\n" : "";
  words_ += "\n" + words_of(table);
}

void Page::add_plot(const Plot& plot, const Table& table, const std::string& caption) {
  if (const std::optional<std::string> data = plot_data(plot, table)) {
    add_drawn(" id=\"plot-" + escaped(plot.name) + "\"", plot.title, *data, caption);
    for (const PlotSeries& series : plot.series) {
      words_ += "\n" + series.title;
    }
  }
}

void Page::add_drawn(const std::string& id, const std::string& title, const std::string& data, const std::string& caption) {
  body_ += "<figure class=\"plot\"" + id + ">" + data_element("class=\"plot-data\"", data) + "<p>Plot: " + escaped(title) +
           ". Scripts draw it.</p><figcaption>" + escaped(caption) + " " + shown_save_link(title, "SVG") +
           "</figcaption></figure>\n";
  words_ += "\n" + title + "\n" + caption;
}

void Page::add_figure(const std::string& url, const std::string& attributes, const std::string& description,
                      const std::string& caption, const std::string& save) {
  body_ += "<figure><img " + attributes + " alt=\"" + escaped(description) + "\" src=\"" + url + "\"><figcaption>" +
           escaped(caption) + (caption.empty() ? "" : " ") + save + "</figcaption></figure>\n";
  words_ += "\n" + description + "\n" + caption;
}

void Page::add_origin(const Origin& origin, const Facts& results) {
  begin_section("To reproduce and to cite it");
  add_text("The command:");
  add_code(origin.command);
  Facts facts = {{"Program", origin.program}, {"Date", origin.date}, {"Computer that ran it", origin.computer}};
  Facts marks = results;
  if (origin.scene_digest) {
    marks.insert(marks.begin(), {"scene", hash_text(*origin.scene_digest)});
  }
  facts.insert(facts.end(), marks.begin(), marks.end());
  for (auto& [name, value] : facts) {
    name = capitalized(name);
  }
  add_facts(facts);
  add_text("Cite as:");
  add_code(citation(title_, origin, marks));
}

void Page::add_style(const WebPart& style) { styles_.push_back(style); }

void Page::add_script(const WebPart& script) { scripts_.push_back(script); }

void Page::add_data(const std::string& id, const std::string& json) {
  data_ += data_element("id=\"" + escaped(id) + "\"", json) + "\n";
}

std::string Page::text() const {
  const std::string list = meanings(words_, glossary_);
  std::vector<std::string> headings = headings_;
  std::string glossary_section;
  if (!list.empty()) {
    headings.emplace_back("Glossary");
    glossary_section = heading_of(headings.size(), headings.back()) + list;
  }
  std::string contents;
  for (std::size_t i = 0; i < headings.size(); ++i) {
    contents += "<a href=\"#" + id_of(i + 1) + "\">" + escaped(headings[i]) + "</a>\n";
  }
  const std::string links = links_of(findings_, headings_);
  const std::string opening = opening_.empty() && links.empty() ? ""
                                                                : "<div class=\"opening\">\n" + opening_ +
                                                                      "<ul class=\"findings\">\n" + links + "</ul>\n</div>\n";
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta http-equiv=\"Content-Security-Policy\" content=\"" +
         policy_of(styles_, scripts_) +
         "\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
         "<meta name=\"color-scheme\" content=\"light dark\">\n<title>" +
         escaped(title_) + "</title>\n" + elements("style", styles_) + "</head>\n<body>\n<main>\n<h1>" + escaped(title_) +
         "</h1>\n" + opening + (contents.empty() ? "" : "<nav aria-label=\"Contents\">\n" + contents + "</nav>\n") + body_ +
         glossary_section + "</main>\n" + data_ + elements("script", scripts_) + "</body>\n</html>\n";
}

}  // namespace dmpc::apps::html
