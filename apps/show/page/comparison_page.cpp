#include "apps/show/page/comparison_page.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/show/page/page.h"
#include "apps/frontend/show/page/shares.h"
#include "apps/frontend/table/plot.h"
#include "apps/show/page/pictures.h"
#include "apps/show/page/player.h"
#include "apps/show/page/typed_array.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps::html {

namespace {

using nlohmann::json;
using Pages = std::array<ComparedPage, 2>;

constexpr std::array<const char*, 2> letters = {"A", "B"};

/// Names in the order in which either run has them, each with the milliseconds of a node.
struct TimeByName {
  std::vector<std::string> names;
  std::array<std::map<std::string, double>, 2> ms;
};

/// Returns the name of nodes' remaining time.
const char* rest_of(const json& run) { return run["clock"] == "virtual time" ? "idle at the end" : "between calls"; }

TimeByName time_by_name(const Pages& pages) {
  TimeByName times;
  const auto add = [&times](std::size_t side, const std::string& name, double ms) {
    if (std::find(times.names.begin(), times.names.end(), name) == times.names.end()) {
      times.names.push_back(name);
    }
    times.ms[side][name] += ms;
  };
  for (std::size_t side = 0; side < pages.size(); ++side) {
    const json& run = pages[side].run.data;
    const double ns_a_ms = 1e6 * run["nodes"].get<double>();
    double rest = run["total_ns"].get<double>() / 1e6;
    for (const char* const kind : {"works", "waits"}) {
      for (const json& work : run[kind]) {
        if (work["name"] != rest_of(run)) {
          add(side, work["name"], work["ns"].get<double>() / ns_a_ms);
          rest -= work["ns"].get<double>() / ns_a_ms;
        }
      }
    }
    add(side, rest_of(run), std::max(0.0, rest));
  }
  return times;
}

double value_of(const std::map<std::string, double>& values, const std::string& name) {
  const auto at = values.find(name);
  return at == values.end() ? 0 : at->second;
}

/// Returns a row for each run and a column for each name: the largest that can be distinguished, and the rest.
Table bars_table(const TimeByName& times) {
  std::vector<std::string> names = times.names;
  const auto larger = [&times](const std::string& name) {
    return std::max(value_of(times.ms[0], name), value_of(times.ms[1], name));
  };
  const std::size_t shown = std::min(names.size(), plot_color_count - 1);
  std::stable_sort(names.begin(), names.end(), [&](const auto& a, const auto& b) { return larger(a) > larger(b); });
  std::vector<Column> columns = {{run_column}};
  for (std::size_t i = 0; i < shown; ++i) {
    columns.push_back({names[i], "ms", 3});
  }
  columns.push_back({rest_column, "ms", 3});
  Table table("What a node's time went to", std::move(columns));
  for (std::size_t side = 0; side < letters.size(); ++side) {
    std::vector<Cell> row = {std::string(letters[side])};
    double rest = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const double ms = value_of(times.ms[side], names[i]);
      if (i < shown) {
        row.emplace_back(ms);
      } else {
        rest += ms;
      }
    }
    row.emplace_back(rest);
    table.add_row(std::move(row));
  }
  return table;
}

Plot bars_plot(const Table& table) {
  Plot plot = stacked_by_node("times", "What a node's time went to", {.label = "ms, mean of nodes", .least = 0}, table.columns());
  plot.place = "run";
  plot.x.label = "run";
  return plot;
}

std::string ms_text(double ms) { return amount_text(ms * 1e6, "ns"); }

/// Returns by how much B takes longer or shorter, and the main cause in a node's time.
std::string run_time_conclusion(const Pages& pages) {
  const double a = pages[0].run.total_ns(), b = pages[1].run.total_ns();
  const std::string took = "A took " + amount_text(a, "ns") + ", B " + amount_text(b, "ns");
  if (a == b) {
    return took + ".";
  }
  const TimeByName times = time_by_name(pages);
  const auto gain = [&](const std::string& name) {
    return (value_of(times.ms[1], name) - value_of(times.ms[0], name)) * (b - a);
  };
  const auto most = std::max_element(times.names.begin(), times.names.end(),
                                     [&](const std::string& left, const std::string& right) { return gain(left) < gain(right); });
  const double ms = value_of(times.ms[1], *most) - value_of(times.ms[0], *most);
  return took + ", " + share_text(std::abs(b - a) / a) + (b < a ? " less" : " more") + "; the largest part of that is \"" +
         *most + "\", " + ms_text(std::abs(ms)) + " a node " + (ms < 0 ? "less" : "more") + ".";
}

/// Returns the words of one command that the other has not, without the names of outputs.
std::string own_words(const json& run, const json& other) {
  const auto words = other["words"].get<std::vector<std::string>>();
  std::vector<std::string> own;
  for (const std::string& word : run["words"].get<std::vector<std::string>>()) {
    const bool is_output = word.starts_with("--report=") || word.ends_with(".png") || word.ends_with(".exr") || word == "-o";
    if (!is_output && std::find(words.begin(), words.end(), word) == words.end()) {
      own.push_back(word);
    }
  }
  return joined(own, " ");
}

/// Returns how the commands differ; empty if they do not.
std::string option_sentence(const Pages& pages) {
  const json &a = pages[0].run.data, &b = pages[1].run.data;
  const std::string own_a = own_words(a, b), own_b = own_words(b, a);
  const auto text = [](const std::string& own) { return own.empty() ? "no other word" : "`" + own + "`"; };
  return own_a.empty() && own_b.empty() ? "" : "A was run with " + text(own_a) + ", B with " + text(own_b) + ".";
}

void add_run(Page& page, const ComparedPage& compared, const char* letter) {
  const json& run = compared.run.data;
  page.add_facts(
      {{std::string(letter), compared.file},
       {"Scene", run["scene"]},
       {"Computer", run["computer"]},
       {run["clock"] == "virtual time" ? "Virtual time" : "Time by the wall clock", amount_text(compared.run.total_ns(), "ns")}});
  page.add_code(joined(run["words"].get<std::vector<std::string>>(), " "));
}

void add_compared_pictures(Page& page, const Comparison& comparison) {
  page.begin_section("Pictures");
  for (std::size_t side = 0; side < letters.size(); ++side) {
    const ComparedPage& compared = comparison.pages[side];
    add_picture(page, compared.picture, std::string("The picture of ") + letters[side],
                std::string(letters[side]) + ": " + compared.file + ", " + std::to_string(compared.run.data["width"].get<int>()) +
                    "x" + std::to_string(compared.run.data["height"].get<int>()) + " pixels.");
  }
}

double sum_of_numbers(const json& array) {
  const std::vector<std::uint64_t> numbers = numbers_of(array).value();
  return core::sum_over<double>(numbers, [&](const std::uint64_t number) { return static_cast<double>(number); });
}

/// Returns sums by name of a field, for fields whose sum has a meaning.
std::map<std::string, double> sums_of(const json& run) {
  std::map<std::string, double> sums;
  for (const json& field : run["fields"]) {
    const std::string name = field["name"];
    if (name != "node" && name != "depth") {
      sums[name] = sum_of_numbers(field["values"]) * field["scale"].get<double>();
    }
  }
  if (run.contains("fetched")) {
    sums["pages fetched"] = run["fetched"].get<double>();
  }
  return sums;
}

Table sums_table(const Pages& pages) {
  Table table("Sums over all pixels", {{"what"}, {"unit"}, {"A", "", 0}, {"B", "", 0}, {"B - A", "", 0}});
  const std::array<std::map<std::string, double>, 2> sums = {sums_of(pages[0].run.data), sums_of(pages[1].run.data)};
  std::map<std::string, std::string> units = {{"pages fetched", ""}};
  for (const ComparedPage& compared : pages) {
    for (const json& field : compared.run.data["fields"]) {
      units.emplace(field["name"], field["unit"]);
    }
  }
  std::map<std::string, double> all = sums[0];
  all.insert(sums[1].begin(), sums[1].end());
  for (const auto& [name, unused] : all) {
    std::vector<Cell> row = {name, units[name]};
    row.resize(table.columns().size());
    for (std::size_t side = 0; side < sums.size(); ++side) {
      if (const auto at = sums[side].find(name); at != sums[side].end()) {
        row[2 + side] = at->second;
      }
    }
    if (sums[0].contains(name) && sums[1].contains(name)) {
      row[4] = sums[1].at(name) - sums[0].at(name);
    }
    table.add_row(std::move(row));
  }
  return table;
}

void add_compared_counters(Page& page, const Comparison& comparison) {
  page.begin_section("Counters");
  page.add_table(sums_table(comparison.pages));
  if (comparison.counters && !comparison.counters->rows().empty()) {
    page.add_table(*comparison.counters);
  }
}

json data_of(const Pages& pages) {
  json runs = json::array();
  for (const ComparedPage& compared : pages) {
    runs.push_back(compared.run.data);
    runs.back()["name"] = compared.file;
  }
  return {{"runs", std::move(runs)}};
}

void check_clocks(const Pages& pages) {
  const json &a = pages[0].run.data["clock"], &b = pages[1].run.data["clock"];
  if (a != b) {
    throw core::InputError("the clock of " + pages[0].file + " is the " + a.get<std::string>() + ", that of " + pages[1].file +
                           " the " + b.get<std::string>() +
                           ", and they have no time in common; render both with --runner=virtual, or neither");
  }
}

}  // namespace

Table time_table(const Pages& pages) {
  const TimeByName times = time_by_name(pages);
  Table table("What a node's time went to", {{"what"}, {"A", "ms", 3}, {"B", "ms", 3}, {"B - A", "ms", 3}});
  const auto add = [&table](const std::string& name, double a, double b) { table.add_row({name, a, b, b - a}); };
  for (const std::string& name : times.names) {
    add(name, value_of(times.ms[0], name), value_of(times.ms[1], name));
  }
  add("the whole run", pages[0].run.total_ns() / 1e6, pages[1].run.total_ns() / 1e6);
  table.add_note(
      std::string(pages[0].run.data["clock"] == "virtual time" ? "Virtual time" : "By the wall clock, which compares schedules") +
      ", the mean of a run's nodes.");
  return table;
}

std::string comparison_page(const Comparison& comparison, const Origin& origin) {
  const Pages& pages = comparison.pages;
  check_clocks(pages);
  Page page("Two runs: " + pages[0].file + " and " + pages[1].file);
  page.end_opening({{option_sentence(pages), "To reproduce and to cite it"},
                    {run_time_conclusion(pages), "plot-times"},
                    {comparison.picture_sentence, "Pictures"},
                    {comparison.counter_sentence, "Counters"}});
  page.add_text(origin.program + ", " + origin.date);
  for (std::size_t side = 0; side < letters.size(); ++side) {
    add_run(page, pages[side], letters[side]);
  }
  if (pages[0].run.data["scene"] != pages[1].run.data["scene"]) {
    page.add_text("They are of different scenes.");
  }
  add_compared_pictures(page, comparison);
  page.begin_section("Where the time went");
  const Table bars = bars_table(time_by_name(pages));
  page.add_plot(bars_plot(bars), bars);
  page.add_table(time_table(pages));
  add_compared_counters(page, comparison);
  page.add_origin(origin, {});
  add_player(page, data_of(pages));
  return page.text();
}

}  // namespace dmpc::apps::html
