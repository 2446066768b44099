#include "apps/formats/reading_memory.h"

#include <array>
#include <string_view>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "core/base/expect.h"
#include "core/database/record_writer.h"
#include "core/record/record.h"

namespace dmpc::apps {
namespace {

/// Peak over size of the file, of sheets of a million triangles, measured in November 2026: OBJ 3.3 (with normals and places)
/// to 5.3, PLY 5.5 (text) to 8.9, STL 2.2 (text) to 3.7, OFF 5.4, GLB 9.3, and less where pictures are in it.
constexpr std::array<std::pair<std::string_view, double>, 5> bytes_a_byte = {
    {{"OBJ", 4.2}, {"PLY", 7}, {"STL", 3}, {"OFF", 5.5}, {"GLB", 8}}};

}  // namespace

std::uint64_t estimated_reading_bytes(const std::string& format, std::uint64_t file_bytes) {
  for (const auto& [known, factor] : bytes_a_byte) {
    if (known == format) {
      return static_cast<std::uint64_t>(factor * static_cast<double>(file_bytes));
    }
  }
  return 0;
}

void check_database(std::uint64_t triangles) {
  constexpr std::uint64_t values = core::value_count(core::PrimitiveKind::triangle);
  constexpr std::uint64_t bytes = values * sizeof(float) + 2 * sizeof(std::uint32_t);  // a block's id and reference beside them
  constexpr double gibibyte = 0x1p30;
  if (triangles > core::RecordWriter::bytes_max / bytes) {
    throw core::CapacityError(
        "its " + grouped(triangles) + " triangles need a database of at least " +
        fixed(static_cast<double>(triangles * bytes) / gibibyte, 1) + " GiB, and one has " +
        fixed(static_cast<double>(core::RecordWriter::bytes_max) / gibibyte, 0) +
        " GiB at most: divide the scene, make it coarser, or, if its meshes stand in many places, have dmpc render "
        "keep each once (--instances=keep)");
  }
}

}  // namespace dmpc::apps
