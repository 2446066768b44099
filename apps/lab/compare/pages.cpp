#include "apps/lab/compare/pages.h"

#include <algorithm>
#include <cstddef>
#include <fstream>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/scratch_folder.h"
#include "apps/frontend/system/text_input.h"
#include "apps/frontend/table/table.h"
#include "apps/lab/difference/picture_error.h"
#include "apps/lab/figures/figures_file.h"
#include "apps/picture/image_file.h"
#include "apps/show/page/comparison_page.h"
#include "apps/show/page/page_data.h"
#include "apps/show/page/pictures.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

constexpr std::size_t rows_max = 1000;  ///< rows of the page's table of counters

/// Checks width and height in the PNG's header (ISO/IEC 15948): four bytes each after signature, length and name of its first
/// chunk.
bool is_small_png(const std::string& bytes) {
  constexpr std::size_t sizes_at = 16;
  const auto side = [&bytes](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
  };
  return bytes.size() > sizes_at + 8 && bytes.starts_with("\x89PNG\r\n") && side(sizes_at) <= html::picture_side_max &&
         side(sizes_at + 4) <= html::picture_side_max;
}

/// Decodes the picture in the confined reader, so that a browser sees only what we have written.
Image picture_of(const PlayedPage& page, Sandbox sandbox) {
  if (!is_small_png(page.run.picture)) {
    throw core::InputError(page.file + ": its picture is no PNG of at most " + std::to_string(html::picture_side_max) +
                           " pixels a side; the page is damaged, or was changed: render it again with --report");
  }
  const ScratchFolder folder;
  const std::filesystem::path path = folder / "picture.png";
  std::ofstream(path, std::ios::binary) << page.run.picture;
  try {
    return read_image(path, sandbox);
  } catch (const core::InputError& error) {
    throw core::InputError(page.file + ": its picture cannot be read: " + error.what());
  }
}

std::string picture_sentence(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height) {
    return "The pictures are of different sizes.";
  }
  const PictureError error = measure_error(a, b);
  return error.differing_pixels == 0
             ? "The pictures are the same in all " + grouped(error.pixels) + " pixels, as eight bits a colour."
             : "The pictures differ in " + grouped(error.differing_pixels) + " of " + grouped(error.pixels) +
                   " pixels, by a root mean square of " + rounded(error.root_mean_square) + ".";
}

Table table_of(const FigureComparison& comparison) {
  Table table("Counters that differ", {{"counter"}, {"A"}, {"B"}});
  const auto text = [](const std::optional<FigureValue>& value) { return value ? text_of(*value) : "not there"; };
  for (std::size_t i = 0; i < std::min(comparison.differences.size(), rows_max); ++i) {
    const Difference& difference = comparison.differences[i];
    table.add_row({difference.name, text(difference.figure), text(difference.reference)});
  }
  if (comparison.differences.size() > rows_max) {
    table.add_note("And " + grouped(comparison.differences.size() - rows_max) +
                   " more: `dmpc compare` without --report shows them with --format=json.");
  }
  return table;
}

}  // namespace

PlayedPage read_page(const std::filesystem::path& file) {
  return {file.string(),
          html::played_run(bounded_text(file, html::page_bytes_max, "a page that dmpc render --report wrote"), file.string())};
}

std::string without_counters(const std::array<PlayedPage, 2>& pages) {
  const PlayedPage& page = pages[0].run.stats ? pages[1] : pages[0];
  return page.file + ": this page has no counters, since an earlier dmpc wrote it; render it again, or compare files of --stats";
}

std::optional<FigureComparison> compare_counters_of(const std::array<PlayedPage, 2>& pages, const FigureChoice& choice,
                                                    bool may_be_absent) {
  if (pages[0].run.stats && pages[1].run.stats) {
    return compare_figures(parse_figures(*pages[0].run.stats, pages[0].file), parse_figures(*pages[1].run.stats, pages[1].file),
                           choice);
  }
  if (!may_be_absent || !choice.only.empty() || !choice.tolerances.empty()) {
    throw core::InputError(without_counters(pages));
  }
  return std::nullopt;
}

std::string page_of(const std::array<PlayedPage, 2>& pages, const std::optional<FigureComparison>& counters, Sandbox sandbox) {
  html::Comparison comparison{.pages = {{{pages[0].file, pages[0].run, picture_of(pages[0], sandbox)},
                                         {pages[1].file, pages[1].run, picture_of(pages[1], sandbox)}}},
                              .picture_sentence = {},
                              .counter_sentence = {}};
  comparison.picture_sentence = picture_sentence(comparison.pages[0].picture, comparison.pages[1].picture);
  if (counters) {
    comparison.counter_sentence =
        grouped(counters->differences.size()) + " of " + counted(counters->compared, "counter") + " differ.";
    comparison.counters = table_of(*counters);
  } else {
    comparison.counter_sentence = without_counters(pages) + ".";
  }
  return html::comparison_page(comparison, this_origin());
}

}  // namespace dmpc::apps
