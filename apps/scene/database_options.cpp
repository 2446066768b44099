#include "apps/scene/database_options.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

#include "apps/edge/line/option_values.h"
#include "apps/edge/line/parsed_number.h"
#include "core/base/expect.h"

namespace dmpc::apps {

const char* name_of(core::RecordOrder order) { return order == core::RecordOrder::scattered ? "scattered" : "spatial"; }

const char* name_of(core::Structure structure) {
  return structure == core::Structure::extents ? "extents" : structure == core::Structure::voxels ? "voxels" : "grid";
}

const std::vector<DatabaseRow>& database_rows() {
  using core::BuildOptions, core::RecordOrder, core::Structure;
  static const std::vector<DatabaseRow> rows = {
      {.name = "--page-size",
       .takes = {core::field_of<&BuildOptions::page_size_bytes>(),
                 [](OptionSet set, const char* name, const char* help, DatabaseOptions& database, const std::string&) {
                   const auto take = [&database](const std::string& text) {
                     database.build.page_size_bytes = parse_page_size(text);
                   };
                   set.add_text(name, "SIZE [1KiB, forest 4KiB]", take, help);
                 }},
       .help = "Size of a page, a power of two from 512B to 64KiB; no record crosses its border"},
      {.name = "--record-order",
       .takes = word<&DatabaseOptions::build, &BuildOptions::record_order>(
           OptionSet::Choices<RecordOrder>{{"spatial", RecordOrder::spatial}, {"scattered", RecordOrder::scattered}}),
       .help = "Which records share a page: neighbours in space, or any (another traffic, the same picture)"},
      {.name = "--structure",
       .takes = word<&DatabaseOptions::build, &BuildOptions::structure>(OptionSet::Choices<Structure>{
           {"grid", Structure::grid}, {"extents", Structure::extents}, {"voxels", Structure::voxels}}),
       .help =
           "How records are found: by a grid whose cells have trees of boxes, by one tree of boxes over all, or by a plain grid "
           "whose voxels have lists (another traffic, the same picture)"},
      {.name = "--voxels",
       .takes = {core::field_of<&BuildOptions::voxels>(),
                 [](OptionSet set, const char* name, const char* help, DatabaseOptions& database, const std::string&) {
                   const auto take = [&database](const std::string& text) { database.build.voxels = parse_voxels(text); };
                   set.add_text(name, "RULE [usual]", take, help);
                 }},
       .help =
           "With --structure=voxels: usual, article (14 a polygon, at most 64^3, polygons of 129 B, no distances), or voxels a "
           "primitive and, N of N^3, at most in all, as in 8:128"}};
  return rows;
}

void add_options(OptionSet options, DatabaseOptions& database) {
  for (const DatabaseRow& row : database_rows()) {
    row.add_to(options, database);
  }
}

namespace {

constexpr double voxels_per_primitive_least = 0.001, voxels_per_primitive_most = 1000;
constexpr double usual_voxels_along = 256, voxels_along_most = 512;

}  // namespace

core::VoxelRule parse_voxels(const std::string& text) {
  if (text == "usual" || text == "article") {
    return text == "usual" ? core::usual_voxels : core::article_voxels;
  }
  core::VoxelRule rule;
  const std::size_t colon = text.find(':');
  const auto each = number_in<double>(std::string_view(text).substr(0, colon));
  const auto along = colon == std::string::npos ? std::optional(usual_voxels_along)
                                                : number_in<double>(std::string_view(text).substr(colon + 1));
  const bool is_good = each && *each >= voxels_per_primitive_least && *each <= voxels_per_primitive_most && along &&
                       *along >= 1 && *along <= voxels_along_most && *along == std::floor(*along);
  if (!is_good) {
    throw core::UsageError("--voxels=" + text +
                           ": expected usual, article, or voxels a primitive from 0.001 to 1000 and, behind a colon, N from 1 to "
                           "512 for at most N^3 in all, as in 14:64");
  }
  rule.voxels_per_primitive = *each;
  const auto edge = static_cast<std::uint64_t>(*along);
  rule.voxels_max = edge * edge * edge;
  return rule;
}

std::string text_of(const core::VoxelRule& rule) {
  if (rule == core::usual_voxels || rule == core::article_voxels) {
    return rule == core::usual_voxels ? "usual" : "article";
  }
  std::array<char, 32> each{};
  const auto [end, error] = std::to_chars(each.data(), each.data() + each.size(), rule.voxels_per_primitive);
  core::expect(error == std::errc(), "a double has at most 24 characters");
  const double along = std::round(std::cbrt(static_cast<double>(rule.voxels_max)));
  return std::string(each.data(), end) + ":" + std::to_string(static_cast<int>(along));
}

void check_voxels(const OptionSet& options, const core::BuildOptions& build) {
  if (options.is_given("--voxels") && build.structure != core::Structure::voxels) {
    throw core::UsageError(std::string("--voxels does not go with --structure=") + name_of(build.structure) +
                           ": only --structure=voxels has any");
  }
}

std::size_t parse_page_size(const std::string& text) {
  const std::size_t bytes = parse_size_bytes(text, "--page-size");
  if (!std::has_single_bit(bytes) || bytes < 512 || bytes > 65536) {
    throw core::UsageError("--page-size=" + text + ": expected a power of two from 512B to 64KiB");
  }
  return bytes;
}

}  // namespace dmpc::apps
