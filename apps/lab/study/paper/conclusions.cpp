#include "apps/lab/study/paper/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

using Row = std::vector<Cell>;

/// Absolute values of numbers over rows.
struct Sizes {
  double sum = 0, most = 0;
  std::size_t count = 0;
  const Row* of_most = nullptr;

  void add(double number, const Row& row) {
    const double size = std::fabs(number);
    if (of_most == nullptr || size > most) {
      most = size;
      of_most = &row;
    }
    sum += size;
    ++count;
  }
  double mean() const { return sum / static_cast<double>(count); }
};

/// Returns those of the rows that have a number in the column.
Sizes sizes_of(const Table& table, const char* column) {
  Sizes sizes;
  for (const Row& row : table.rows()) {
    if (const auto number = number_in(table, row, column)) {
      sizes.add(*number, row);
    }
  }
  return sizes;
}

/// Returns "Teapot, nodes 64", from the row's first two cells.
std::string place_of(const Table& table, const Row& row) {
  const std::vector<std::string> texts = texts_of(table, row);
  return texts[0] + ", " + table.columns()[1].name + " " + texts[1];
}

std::string points_text(double points) { return fixed(points, 1) + " points"; }

/// Returns the rows with the maximum of column `name`.
std::vector<const Row*> rows_of_most(const Table& table, const char* name) {
  std::vector<const Row*> rows;
  const Sizes sizes = sizes_of(table, name);
  for (const Row& row : table.rows()) {
    if (number_in(table, row, name) == sizes.most) {
      rows.push_back(&row);
    }
  }
  return rows;
}

std::string on_table_2(const Table& table) {
  std::vector<double> ratios;
  for (const Row& row : table.rows()) {
    const auto printed = number_in(table, row, "pages a pixel printed"), ours = number_in(table, row, "pages a pixel");
    if (printed && ours && *printed > 0) {
      ratios.push_back(*ours / *printed);
    }
  }
  if (ratios.empty()) {
    return "";
  }
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return "A pixel takes " + fixed(*least, 2) + " to " + fixed(*most, 2) + " times the pages that the article prints.";
}

std::string on_table_3(const Table& table) {
  Sizes sizes;
  for (const Row& row : table.rows()) {
    const auto difference = number_in(table, row, "difference");
    if (difference && texts_of(table, row).back() == "predicted") {
      sizes.add(*difference, row);
    }
  }
  return sizes.count == 0 ? ""
                          : "The efficiencies that were predicted lie " + points_text(sizes.mean()) +
                                " from the printed ones in the mean, at worst " + points_text(sizes.most) + " (" +
                                place_of(table, *sizes.of_most) + ").";
}

std::string on_calibration(const Table& table) {
  const Sizes sizes = sizes_of(table, "change");
  return sizes.count == 0 ? ""
                          : "The fit changes a figure of the machine by " + fixed(sizes.most, 1) + " % at most (" +
                                texts_of(table, *sizes.of_most)[0] + ").";
}

std::string on_errors(const Table& table) {
  if (table.rows().empty()) {
    return "";
  }
  const auto ours = number_in(table, table.rows()[0], "our mean error"),
             model = number_in(table, table.rows()[0], "the law's mean error");
  if (!ours || !model) {
    return "";
  }
  return "Over " + texts_of(table, table.rows()[0])[0] + " " + (*ours < *model ? "we are" : "the law is") +
         " nearer: " + points_text(std::min(*ours, *model)) + " off in the mean, against " +
         points_text(std::max(*ours, *model)) + ".";
}

std::string on_losses(const Table& table) {
  const std::vector<const Row*> rows = rows_of_most(table, "nodes");
  std::pair<double, std::string> largest;
  for (const Column& column : table.columns()) {
    const double sum = core::sum_over<double>(rows, [&](const Row* row) {
      return column.unit == "%" && column.name != "computing" ? number_in(table, *row, column.name).value_or(0) : 0;
    });
    largest = std::max(largest, {sum, column.name});
  }
  if (rows.empty() || largest.first == 0) {
    return "";
  }
  std::replace(largest.second.begin(), largest.second.end(), '_', ' ');
  return "On " + fixed(*number_in(table, *rows[0], "nodes"), 0) + " nodes the largest loss is " + largest.second + ": " +
         fixed(largest.first / static_cast<double>(rows.size()), 1) + " % of the nodes' time in the mean over scenes.";
}

std::string on_algorithms(const Table& table) {
  std::string text;
  for (const Row* row : rows_of_most(table, "nodes")) {
    const auto rays = number_in(table, *row, "rays travel"), pages = number_in(table, *row, "pages travel");
    if (rays && pages && *rays > 0 && *pages > 0) {
      text += (text.empty() ? "On " + texts_of(table, *row)[1] + " nodes pages that travel take " : ", ") +
              fixed(*pages / *rays, 2) + " times as long as rays (" + texts_of(table, *row)[0] + ")";
    }
  }
  return text.empty() ? "" : text + ".";
}

std::string on_caches(const Table& table) {
  const Sizes sizes = sizes_of(table, "efficiency");
  if (sizes.count == 0) {
    return "";
  }
  const auto worst = std::min_element(table.rows().begin(), table.rows().end(), [&](const Row& a, const Row& b) {
    return number_in(table, a, "efficiency") < number_in(table, b, "efficiency");
  });
  const auto share = [&](const Row& row) { return fixed(number_in(table, row, "of the database").value_or(0), 2) + " %"; };
  return "The efficiency goes from " + fixed(number_in(table, *worst, "efficiency").value_or(0), 1) + " % with caches of " +
         share(*worst) + " of the database to " + fixed(sizes.most, 1) + " % with " + share(*sizes.of_most) + ".";
}

std::string on_ray_ways(const Table& table) {
  const Sizes sizes = sizes_of(table, "efficiency");
  return sizes.count == 0 ? ""
                          : "Rays travel best, with an efficiency of " + fixed(sizes.most, 1) + " %, on " +
                                texts_of(table, *sizes.of_most)[0] + " by " + texts_of(table, *sizes.of_most)[1] + ".";
}

std::string on_work_items(const Table& table) {
  if (table.rows().empty()) {
    return "";
  }
  const auto seconds = [&](const Row& row) { return number_in(table, row, "seconds").value_or(0); };
  const auto [least, most] = std::minmax_element(table.rows().begin(), table.rows().end(),
                                                 [&](const Row& a, const Row& b) { return seconds(a) < seconds(b); });
  const auto of = [&](const Row& row) {
    return fixed(seconds(row), 0) + " s with " + texts_of(table, row)[0] + " asked of " + texts_of(table, row)[1];
  };
  return "The picture takes from " + of(*least) + " to " + of(*most) + ".";
}

std::string on_claims(const Table& table) {
  std::map<std::string, std::size_t> verdicts;
  for (const Row& row : table.rows()) {
    ++verdicts[texts_of(table, row)[1]];
  }
  if (table.rows().empty()) {
    return "";
  }
  const std::string judged = std::to_string(verdicts["held"]) + " of " + counted(table.rows().size(), "claim") + " held";
  return verdicts["not judged"] > 0 ? judged + ", " + std::to_string(verdicts["not judged"]) + " were not judged." : judged + ".";
}

std::string on_sensitivity(const Table& table) {
  const Sizes errors = sizes_of(table, "mean error");
  return errors.count == 0 ? ""
                           : "The mean error is largest, " + points_text(errors.most) + ", where \"" +
                                 texts_of(table, *errors.of_most)[0] + "\" is changed.";
}

std::string on_pairs(const Table& table) {
  const auto best = std::min_element(table.rows().begin(), table.rows().end(), [&](const Row& a, const Row& b) {
    return number_in(table, a, "mean error") < number_in(table, b, "mean error");
  });
  const Sizes errors = sizes_of(table, "mean error");
  return errors.count == 0 ? ""
                           : "Times of a ray are met to " + fixed(number_in(table, *best, "mean error").value_or(0), 1) +
                                 " % in the mean by prices fitted to " + texts_of(table, *best)[0] + ", and to " +
                                 fixed(errors.most, 1) + " % by those fitted to " + texts_of(table, *errors.of_most)[0] + ".";
}

std::string on_loads(const Table& table) {
  const Sizes loads = sizes_of(table, "average load");
  return loads.count == 0
             ? ""
             : "Nodes are loaded most evenly, to " + fixed(loads.most, 1) + " % of the busiest, by regions that are " +
                   texts_of(table, *loads.of_most)[0] + " on " + texts_of(table, *loads.of_most)[1] + " nodes.";
}

struct Conclusion {
  const char* name;
  std::string (*on)(const Table& table);
};

constexpr std::array<Conclusion, 15> conclusions = {{{"claims", on_claims},
                                                     {"table_2", on_table_2},
                                                     {"table_3", on_table_3},
                                                     {"algorithms", on_algorithms},
                                                     {"caches", on_caches},
                                                     {"region_loads", on_loads},
                                                     {"ray_ways", on_ray_ways},
                                                     {"work_items", on_work_items},
                                                     {"losses", on_losses},
                                                     {"voxel_prices", on_calibration},
                                                     {"voxel_pairs", on_pairs},
                                                     {"law", on_errors},
                                                     {"grid_table_3", on_table_3},
                                                     {"calibration", on_calibration},
                                                     {"sensitivity", on_sensitivity}}};

}  // namespace

std::string paper_conclusion(const std::string& name, const Table& table) {
  const auto found =
      std::find_if(conclusions.begin(), conclusions.end(), [&](const Conclusion& one) { return one.name == name; });
  return found == conclusions.end() ? "" : found->on(table);
}

}  // namespace dmpc::apps
