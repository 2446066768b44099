#include "apps/render/frame_files.h"

#include <filesystem>
#include <system_error>

#include "apps/frontend/line/number_text.h"
#include "apps/render/outputs.h"
#include "apps/run/frame_name.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

namespace fs = std::filesystem;

/// Calls visit(option, path) of each output of which every frame has one.
template <class Options, class Visit>
void visit_names(Options& options, const Visit& visit) {
  visit("-o", options.image);
  if (options.stats) {
    visit("--stats", *options.stats);
  }
  for (auto& request : options.heat_maps) {
    visit("--heatmap", request.path);
  }
  for (auto& request : options.layers) {
    if (request.path) {
      visit("--aov", *request.path);
    }
  }
}

void check_names(const RenderOptions& asked) {
  visit_names(asked, [&asked](const std::string& option, const fs::path& path) {
    if (!FrameName::in(path, option) && asked.frames.are_several()) {
      throw core::UsageError(option + "=" + path.string() +
                             ": for several frames expected a placeholder for the frame's number in the file's name, such as "
                             "out.####.png or out.%04d.png");
    }
  });
}

/// What a pixel takes before it is packed.
std::uint64_t pixel_bytes(const fs::path& picture) {
  const std::string ending = picture.extension().string();
  return ending == ".exr" || ending == ".tif" || ending == ".tiff" ? 12 : 3;
}

/// With the names of that frame.
RenderOptions options_of(const RenderOptions& asked, std::uint64_t frame) {
  RenderOptions options = asked;
  visit_names(options, [frame](const std::string&, fs::path& path) {
    if (const auto name = FrameName::in(path, "")) {
      path = name->of(frame);
    }
  });
  return options;
}

/// Where names have numbers.
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

}  // namespace

DueFrames::DueFrames(const RenderOptions& asked) : asked_(asked) {
  if (!asked.frames.range) {
    return;
  }
  check_names(asked);
  there_ = frames_there(asked);
  if (!there_.empty() && !asked.checkpoint.resumes) {
    throw core::InputError("-o " + options_of(asked, *there_.begin()).image.string() + ": the picture of this frame" +
                           (there_.size() == 1 ? " is" : ", and of " + grouped(there_.size() - 1) + " more, is") +
                           " there already: skip what is there with --resume, remove it, or give another name");
  }
}

std::string DueFrames::note() const {
  return there_.empty() ? ""
                        : counted(there_.size(), "frame") + " of " + grouped(asked_.frames.range->count()) +
                              (there_.size() == 1 ? " is there and is skipped" : " are there and are skipped");
}

std::optional<DueFrame> DueFrames::first() const {
  return asked_.frames.range ? missing_from(asked_.frames.range->first) : DueFrame{std::nullopt, asked_, outputs_of(asked_)};
}

std::optional<DueFrame> DueFrames::after(const DueFrame& last) const {
  return last.number ? missing_from(*last.number + 1) : std::nullopt;
}

std::optional<DueFrame> DueFrames::missing_from(std::uint64_t number) const {
  while (number <= asked_.frames.range->last && (was_there(number) || is_there_by_now(number))) {
    ++number;
  }
  if (number > asked_.frames.range->last) {
    return std::nullopt;
  }
  RenderOptions options = options_of(asked_, number);
  return DueFrame{number, options, outputs_of(options)};
}

bool DueFrames::is_there_by_now(std::uint64_t number) const {
  const fs::path picture = options_of(asked_, number).image;
  std::error_code error;
  const bool is_there = picture != asked_.image && fs::exists(picture, error);
  if (is_there && !asked_.checkpoint.resumes) {
    throw core::InputError("-o " + picture.string() +
                           ": the picture of this frame has been written meanwhile: --resume continues " +
                           "with those that are missing");
  }
  return is_there;
}

std::string DueFrames::disk_note(std::uint64_t pixel_count) const {
  if (!asked_.frames.range) {
    return "";
  }
  const std::uint64_t frame_count = asked_.frames.range->count() - there_.size();
  const fs::path folder = asked_.image.parent_path();
  std::error_code error;
  const fs::space_info space = fs::space(folder.empty() ? fs::path(".") : folder, error);
  const std::uint64_t picture_bytes = pixel_count * pixel_bytes(asked_.image);
  if (error || static_cast<double>(frame_count) * static_cast<double>(picture_bytes) <= static_cast<double>(space.available)) {
    return "";
  }
  return "pictures of " + counted(frame_count, "frame") + " take up to " + bytes_text(picture_bytes) + " each, " +
         rounded(static_cast<double>(frame_count) * static_cast<double>(picture_bytes) / 0x1p30) + " GiB in all, and " +
         bytes_text(space.available) + " are free in their folder";
}

}  // namespace dmpc::apps
