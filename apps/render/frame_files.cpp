#include "apps/render/frame_files.h"

#include <filesystem>
#include <system_error>

#include "apps/edge/line/number_text.h"
#include "apps/run/frame_name.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

void check_name(const RenderOptions& asked, const std::string& option, const fs::path& path) {
  if (!FrameName::in(path, option) && asked.frames.are_several()) {
    throw core::UsageError(option + "=" + path.string() +
                           ": of several frames expected a place for the frame's number in the file's name, such as in "
                           "out.####.png or out.%04d.png");
  }
}

fs::path of_frame(const fs::path& path, std::uint64_t frame) {
  const auto name = FrameName::in(path, "");
  return name ? name->of(frame) : path;
}

/// What a pixel takes before it is packed.
std::uint64_t pixel_bytes(const fs::path& picture) {
  const std::string ending = picture.extension().string();
  return ending == ".exr" || ending == ".tif" || ending == ".tiff" ? 12 : 3;
}

}  // namespace

void check_frame_names(const RenderOptions& asked) {
  check_name(asked, "-o", asked.image);
  if (asked.stats) {
    check_name(asked, "--stats", *asked.stats);
  }
  for (const HeatRequest& request : asked.heat_maps) {
    check_name(asked, "--heatmap", request.path);
  }
}

RenderOptions options_of(const RenderOptions& asked, std::uint64_t frame) {
  RenderOptions options = asked;
  options.image = of_frame(asked.image, frame);
  if (asked.stats) {
    options.stats = of_frame(*asked.stats, frame);
  }
  for (HeatRequest& request : options.heat_maps) {
    request.path = of_frame(request.path, frame);
  }
  return options;
}

std::set<std::uint64_t> frames_there(const RenderOptions& asked) {
  std::set<std::uint64_t> frames;
  const auto name = FrameName::in(asked.image, "-o");
  if (!name) {
    return frames;
  }
  std::error_code error;
  const fs::path folder = name->folder().empty() ? fs::path(".") : name->folder();
  for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error)) {
    const auto frame = name->frame_of(file->path().filename().string());
    if (frame && *frame >= asked.frames.range->first && *frame <= asked.frames.range->last) {
      frames.insert(*frame);
    }
  }
  if (error) {
    throw core::InputError("-o " + asked.image.string() + ": the folder " + folder.string() +
                           " cannot be read: " + error.message());
  }
  return frames;
}

std::string disk_note(const RenderOptions& asked, std::uint64_t frame_count, std::uint64_t pixel_count) {
  const fs::path folder = asked.image.parent_path();
  std::error_code error;
  const fs::space_info space = fs::space(folder.empty() ? fs::path(".") : folder, error);
  const std::uint64_t picture_bytes = pixel_count * pixel_bytes(asked.image);
  if (error || static_cast<double>(frame_count) * static_cast<double>(picture_bytes) <= static_cast<double>(space.available)) {
    return "";
  }
  return "pictures of " + counted(frame_count, "frame") + " take up to " + bytes_text(picture_bytes) + " each, " +
         rounded(static_cast<double>(frame_count) * static_cast<double>(picture_bytes) / 0x1p30) + " GiB in all, and " +
         bytes_text(space.available) + " are free where they go";
}

}  // namespace dmpc::apps
