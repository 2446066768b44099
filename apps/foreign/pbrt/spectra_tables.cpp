#include "apps/foreign/pbrt/spectra_tables.h"

#include <map>
#include <optional>
#include <utility>

#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/line/text_table.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
extern const char* const spectra_file;  // defined in a source that CMake generates from spectra.txt
}

namespace dmpc::apps::pbrt {
namespace {

using Rows = std::map<std::pair<std::string_view, std::string_view>, std::vector<double>>;

double tabulated_number(std::string_view text) {
  const std::optional<double> number = number_in<double>(text);
  core::expect(number.has_value(), "tables of spectra have numbers");
  return *number;
}

Rows read_spectra() {
  Rows rows;
  for (const auto& row : table_rows(spectra_file, 3)) {
    rows[{row[0], row[1]}] = core::mapped<double>(parts_between(row[2], " "), tabulated_number);
  }
  return rows;
}

}  // namespace

const std::vector<double>* tabulated(std::string_view kind, std::string_view name) {
  static const Rows rows = read_spectra();
  const auto found = rows.find({kind, name});
  return found == rows.end() ? nullptr : &found->second;
}

}  // namespace dmpc::apps::pbrt
