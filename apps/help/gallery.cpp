#include "apps/help/gallery.h"

#include <algorithm>
#include <cstddef>
#include <iostream>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/system/progress.h"
#include "apps/picture/film_image.h"
#include "apps/picture/glyphs.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

/// Puts `part` into `image`, its upper left pixel there. Requires that it fits.
void inset(Image& image, int left, int top, const Image& part) {
  core::expect(left >= 0 && top >= 0 && left + part.width <= image.width && top + part.height <= image.height,
               "a picture lies whole within another");
  const auto row_floats = static_cast<std::ptrdiff_t>(part.width) * 3;
  for (int y = 0; y < part.height; ++y) {
    const std::ptrdiff_t to = (static_cast<std::ptrdiff_t>(top + y) * image.width + left) * 3;
    std::copy_n(part.rgb.begin() + y * row_floats, row_floats, image.rgb.begin() + to);
  }
}

namespace fs = std::filesystem;

constexpr int side = 104, samples = 4;
constexpr int column_count = 6, gap = 4;
constexpr const char* sheet_name = "scenes.png";
constexpr core::Color white{1, 1, 1}, black{0, 0, 0};

/// One of each family, and trees.
std::vector<std::string> shown_scenes() {
  std::vector<std::string> names = core::mapped<std::string>(core::default_scenes(), &core::SceneName::text);
  names.emplace_back("grove-4");
  return names;
}

fs::path file_of(const fs::path& folder, const std::string& scene) { return folder / (scene + ".png"); }

/// Somebody's own, perhaps.
void check_nothing_there(const fs::path& folder) {
  std::vector<fs::path> files =
      core::mapped<fs::path>(shown_scenes(), [&](const std::string& scene) { return file_of(folder, scene); });
  files.push_back(folder / sheet_name);
  std::error_code error;
  std::erase_if(files, [&error](const fs::path& file) { return !fs::exists(fs::symlink_status(file, error)); });
  if (!files.empty()) {
    throw core::InputError("--pictures " + folder.string() + ": " + files.front().string() +
                           (files.size() == 1 ? " is" : ", and " + grouped(files.size() - 1) + " more, are") +
                           " there already and not written over: remove what is there, or give another folder");
  }
}

/// On eight nodes, as `dmpc render SCENE` does.
Image rendered(const std::string& scene, const nodes::Progress& progress, const Interrupt& interrupt) {
  PictureOptions picture;
  picture.scene = scene;
  picture.resolution = {.width = side, .height = side};
  picture.samples = samples;
  StrategyOptions options;
  Subject subject = build_subject_quietly(load_scene(picture, LoadNotes::silent), picture, DatabaseOptions());
  const ReadyRun run = make_ready(options, subject.database, subject.settings, interrupt.token());
  interrupt.check();
  const Report report = run.start(progress, interrupt.token());
  interrupt.check();
  return image_of(account_of(report).film);
}

std::vector<ScenePicture> rendered_scenes(const Interrupt& interrupt) {
  const std::vector<std::string> scenes = shown_scenes();
  Progress progress(std::cerr, stderr_is_terminal());
  std::vector<ScenePicture> pictures;
  for (const std::string& scene : scenes) {
    const std::size_t number = pictures.size();
    const auto update = [&](std::uint32_t done, std::uint32_t total) {
      progress.show(scene, number * total + done, scenes.size() * total);
    };
    pictures.push_back({scene, rendered(scene, update, interrupt)});
  }
  return pictures;
}

}  // namespace

Image contact_sheet(const std::vector<ScenePicture>& pictures) {
  core::expect(!pictures.empty(), "a contact sheet shows pictures");
  const Image& first = pictures.front().image;
  const int column = first.width + gap, row = first.height + glyph_height + 3 * gap;
  const int columns = std::min(column_count, static_cast<int>(pictures.size()));
  const int rows = (static_cast<int>(pictures.size()) + columns - 1) / columns;
  Image sheet(columns * column + gap, rows * row + gap);
  fill(sheet, 0, 0, sheet.width, sheet.height, white);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int left = gap + static_cast<int>(i) % columns * column, top = gap + static_cast<int>(i) / columns * row;
    inset(sheet, left, top, pictures[i].image);
    draw_text(sheet, {left, top + first.height + gap, 1}, pictures[i].name, black);
  }
  return sheet;
}

void write_gallery(const fs::path& folder, Interrupt& interrupt) {
  check_nothing_there(folder);
  make_output_folder(folder, "--pictures");
  const std::vector<ScenePicture> pictures = rendered_scenes(interrupt);
  interrupt.set_consequence("some pictures may not have been written");
  const Interrupt::EndAtOnce end_at_once(interrupt);
  check_nothing_there(folder);  // that has come meanwhile
  for (const ScenePicture& picture : pictures) {
    write_image(folder / (picture.name + ".png"), picture.image);
  }
  write_image(folder / sheet_name, contact_sheet(pictures));
}

}  // namespace dmpc::apps
