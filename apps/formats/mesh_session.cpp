#include "apps/formats/mesh_session.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "apps/formats/named_file.h"
#include "apps/formats/reading_memory.h"
#include "apps/formats/scene_blocks.h"
#include "apps/formats/view_faults.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "apps/frontend/system/available_memory.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/picture/picture_reader.h"
#include "apps/picture/texture_file.h"
#include "apps/reader/file_access.h"
#include "apps/reader/process.h"
#include "core/base/expect.h"
#include "core/scene/texture.h"

namespace dmpc::apps {

namespace fs = std::filesystem;

namespace {

/// Beside what a file becomes: libraries' own.
constexpr std::uint64_t spare_bytes = std::uint64_t{2} << 30U;
constexpr std::uint64_t memory_per_byte = 1024;
/// So long is a texture within a file at most.
constexpr std::uint64_t texture_bytes_max = std::uint64_t{2} << 30U;
/// More than any scene has, each of which is kept until all are there.
constexpr std::size_t skies_max = 16;
constexpr std::uint64_t note_bytes_max = std::uint64_t{1} << 20U;

std::uint64_t memory_bytes_for(std::uint64_t file_bytes) {
  return std::min(spare_bytes + memory_per_byte * file_bytes, reader_memory_bytes_max());
}

/// A file that is mapped takes addresses, and memory only as long as there is some.
std::uint64_t address_bytes_for(std::uint64_t file_bytes) { return memory_bytes_for(file_bytes) + file_bytes; }

/// The bytes of a file that may belong to the scene: it is no larger than what lies beside that.
std::uint64_t bytes_of(const std::string& path) { return find_input_file(path).bytes; }

std::uint64_t bytes_around(const std::string& path) {
  std::uint64_t bytes = bytes_of(path);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::absolute(path).parent_path(), error)) {
    bytes += entry.is_regular_file(error) ? entry.file_size(error) : 0;
  }
  return bytes;
}

std::string format_of(const std::string& path) {
  std::string ending = fs::path(has_own_sky(path) ? "a.pbrt" : path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::toupper(c); });
  return ending.empty() ? "these" : ending.substr(1);
}

ReaderLimits with_sandbox(ReaderLimits limits, Sandbox sandbox) {
  limits.sandbox = sandbox;
  return limits;
}

TextureEdges take_edges(Unpacker& fields) {
  const auto s = fields.take_choice(core::TextureWrap::clamp), t = fields.take_choice(core::TextureWrap::clamp);
  const auto alpha = fields.take_choice(TextureAlpha::kept);
  const auto cutoff = fields.take<double>(), coat = fields.take<double>();
  Unpacker::require(cutoff >= 0 && cutoff <= 1 && coat >= 0 && coat <= coat_max);
  return {s, t, alpha, cutoff, coat};
}

/// Opens the files that the scene may open, has its textures read, and trusts no message.
class MeshSession {
 public:
  MeshSession(const std::string& path, const MeshOptions& options, bool shows_progress, const ReaderLimits& limits)
      : path_(path),
        options_(options),
        access_(path, options.opens_anywhere),
        file_bytes_(bytes_of(path)),
        shows_progress_(shows_progress),
        progress_(std::cerr, shows_progress, "Reading " + path + ":", "bytes"),
        pictures_(with_sandbox(limits, options.sandbox)),
        budget_(with_sandbox(limits, options.sandbox)),
        process_("dmpc_mesh_reader", address_bytes_for(bytes_around(path)), budget_),
        receiver_({}, options.copies),
        current_(path) {}

  MeshFile read() {
    say_memory();
    try {
      ask();
      while (!answer(process_.receive())) {
      }
      result_.scene = receiver_.finish();
    } catch (const ReaderDeath& death) {
      throw core::InputError("the reader of " + format_of(path_) + " files " + death.what() +
                             (current_ == path_ ? "" : ", while it had " + current_) +
                             ": the file is damaged, or more than its reader can take; write it anew, or as another format");
    } catch (const Nonsense& nonsense) {
      throw core::InputError(std::string(nonsense.what()) + ": the file is damaged; write it anew, or as another format");
    } catch (const core::CapacityError& error) {
      const std::string text = error.what();
      throw text.starts_with("took")
          ? core::CapacityError("the reader of " + format_of(path_) + " files " + text + ": make the scene smaller, or divide it")
          : error;
    }
    note_alpha();
    result_.scene.name = path_;
    result_.opened = access_.opened();
    return std::move(result_);
  }

 private:
  void ask() {
    Packer fields;
    fields.add_text(path_).add(reader_memory_bytes_max());
    fields.add_optional(options_.scale)
        .add_optional(options_.up)
        .add_optional(options_.smooth_degrees)
        .add_optional(options_.size);
    for (const bool flag : {options_.allows_missing, options_.is_seen_otherwise, options_.is_lit_otherwise, options_.is_below_sky,
                            options_.is_below_own_sky, options_.is_by_paths}) {
      fields.add_flag(flag);
    }
    fields.add(options_.copies);
    if (const auto& moment = options_.animation) {
      fields.add_text(moment->name).add(moment->seconds).add(moment->frames_per_second).add_optional(moment->still);
    }
    process_.send(Saying::read_mesh, fields);
  }

  /// Returns whether it was the last message.
  bool answer(const Message& message) {
    static const std::map<Saying, void (MeshSession::*)(const Message&)> answers = {
        {Saying::open, &MeshSession::answer_question},
        {Saying::exists, &MeshSession::answer_question},
        {Saying::meant, &MeshSession::answer_question},
        {Saying::progress, &MeshSession::show},
        {Saying::lies_here, &MeshSession::take_over},
        {Saying::bytes, &MeshSession::add_bytes},
        {Saying::texture_file, &MeshSession::answer_texture},
        {Saying::texture_bytes, &MeshSession::answer_texture},
        {Saying::sky, &MeshSession::add_sky},
        {Saying::bounds, &MeshSession::take_bounds},
        {Saying::note, &MeshSession::add_note}};
    if (message.saying == Saying::done) {
      return true;
    }
    if (message.saying == Saying::bad_input) {
      throw core::InputError(Unpacker(message.bytes).take_text());
    }
    if (message.saying == Saying::no_room) {
      throw core::CapacityError(Unpacker(message.bytes).take_text());
    }
    if (receiver_.take(message)) {
      return false;
    }
    const auto found = answers.find(message.saying);
    if (found == answers.end()) {
      throw Nonsense("what its reader says of it is nonsense");
    }
    (this->*found->second)(message);
    return false;
  }

  /// Answers requests for files, within the budget.
  /// Looking for files takes time of dmpc's own, which hundreds of thousands of names would have for nothing.
  void answer_question(const Message& message) {
    ProcessorStopwatch stopwatch(CLOCK_THREAD_CPUTIME_ID);
    Unpacker fields(message.bytes);
    if (message.saying == Saying::open) {
      answer_open(fields.take_text());
    } else if (message.saying == Saying::exists) {
      process_.send(access_.has(fields.take_text()) ? Saying::yes : Saying::no);
    } else {
      answer_meant(fields);
    }
    spend(stopwatch);
  }

  /// Says "no" where a file cannot be had; all else that may be thrown is no matter of that file alone.
  void refuse_if_missing(const std::function<void()>& act) {
    try {
      act();
    } catch (const ReaderDeath&) {
      throw;
    } catch (const Nonsense&) {
      throw;
    } catch (const core::CapacityError&) {  // nothing is missing
      throw;
    } catch (const core::InputError& error) {
      process_.send(Saying::no, Packer().add_text(error.what()));
    }
  }

  void answer_open(const std::string& path) {
    refuse_if_missing([&] {
      const auto [file, is_new] = open(path);
      current_ = path;
      const std::uint64_t there = is_new ? bytes_without_holes(file.descriptor, file.bytes) : 0;
      pictures_.add_bytes(there);
      process_.send(Saying::file, Packer().add(file.bytes), &file.descriptor, there);
    });
  }

  /// And whether for the first time: else it would get time for each of a thousand mentions.
  std::pair<InputFile, bool> open(const std::string& path) {
    const std::size_t known = access_.opened().paths().size();
    InputFile file = access_.open(path);
    return {std::move(file), access_.opened().paths().size() > known};
  }

  PictureFile open_picture(const std::string& path) {
    auto [file, is_new] = open(path);
    std::string ending = fs::path(path).extension().string();
    ending.erase(0, 1);
    return {std::move(file.descriptor), file.bytes, path, ending, is_new};
  }

  void answer_meant(Unpacker fields) {
    const std::string folder = fields.take_text();
    Packer names;
    for (const fs::path& path : files_meant(folder, fields.take_text())) {
      if (access_.has(path) && names.bytes().size() + path.string().size() + sizeof(std::uint32_t) < message_bytes_max) {
        names.add_text(path.string());
      }
    }
    process_.send(Saying::names, names);
  }

  void answer_texture(const Message& message) {
    refuse_if_missing([&] {
      Unpacker fields(message.bytes);
      const bool is_weighed = fields.take_flag();
      const PictureFile file = message.saying == Saying::texture_file ? picture_of_file(fields) : picture_of_bytes(fields);
      const TextureEdges edges = take_edges(fields);
      if (is_weighed) {
        pictures_.weigh_texture(file);
      } else {
        receiver_.add(pictures_.read_texture(file, edges));
      }
      process_.send(Saying::yes);
    });
    bytes_.clear();
  }

  PictureFile picture_of_file(Unpacker& fields) {
    PictureFile file = open_picture(fields.take_text());
    budget_.add_bytes(file.is_new ? bytes_without_holes(file.descriptor, file.bytes) : 0);
    return file;
  }

  PictureFile picture_of_bytes(Unpacker& fields) {
    const std::string name = fields.take_text(), hint = fields.take_text();
    PictureFile file = picture_of(std::as_bytes(std::span(bytes_)), name, hint);
    file.is_new = false;  // it lies in a file that has renewed the time
    return file;
  }

  /// Where that cannot be, the same comes in messages from then on. Copying takes time of dmpc's own, too.
  void take_over(const Message& message) {
    Unpacker fields(message.bytes);
    Unpacker::require(can_copy_);
    ProcessorStopwatch stopwatch(CLOCK_THREAD_CPUTIME_ID);
    const Saying list = fields.take_choice(Saying::spheres);
    auto address = fields.take<std::uint64_t>();
    const auto bytes = fields.take<std::uint64_t>();
    fields.finish();
    constexpr std::uint64_t growth_of_index = sizeof(core::Vec3d) / sizeof(std::uint32_t);
    can_copy_ = receiver_.take_from(list, bytes, [&](std::span<std::byte> room) {
      return process_.copy(std::exchange(address, address + room.size()), room, list == Saying::vertices ? growth_of_index : 1);
    });
    process_.send(can_copy_ ? Saying::yes : Saying::no);
    spend(stopwatch);
  }

  void spend(ProcessorStopwatch& stopwatch) {
    budget_.spend(std::chrono::duration_cast<ReadingBudget::Time>(std::chrono::duration<double>(stopwatch.lap())));
  }

  void add_bytes(const Message& message) {
    Unpacker::require(bytes_.size() + message.bytes.size() <= texture_bytes_max);
    bytes_ += message.bytes;
  }

  /// A picture, which no reader of meshes sees.
  void add_sky(const Message& message) {
    Unpacker fields(message.bytes);
    const std::string path = fields.take_text();
    MeshSky sky{.name = path, .image = {}, .rows = {}, .scale = {}};
    for (core::Vec3d& row : sky.rows) {
      row = fields.take<core::Vec3d>();
    }
    sky.scale = fields.take<core::Vec3d>();
    fields.finish();
    Unpacker::require(options_.is_below_own_sky && result_.skies.size() < skies_max);
    sky.image = pictures_.read_sky(open_picture(path));
    result_.skies.push_back(std::move(sky));
  }

  void take_bounds(const Message& message) {
    Unpacker fields(message.bytes);
    const auto center = fields.take<core::Vec3d>();
    const auto radius = fields.take<double>(), light_share = fields.take<double>();
    fields.finish();
    Unpacker::require(options_.animation && is_in_reach(center) && radius >= 0 && radius <= 2 * view_coordinate_max);
    Unpacker::require(light_share >= 0 && light_share <= 1);
    result_.still.bounds = {center, radius};
    result_.still.light_share = light_share;
  }

  void add_note(const Message& message) {
    result_.notes.push_back(Unpacker(message.bytes).take_text());
    note_bytes_ += result_.notes.back().size() + 1;
    Unpacker::require(note_bytes_ <= note_bytes_max);
  }

  /// Which textures have alpha is known here alone.
  void note_alpha() {
    const auto& materials = result_.scene.materials;
    const auto count = std::count_if(materials.begin(), materials.end(),
                                     [](const core::Material& material) { return material.alpha != core::AlphaUse::none; });
    if (count > 0) {
      result_.notes.push_back(
          "materials that alpha cuts out or blends, each of whose faces takes one of --depth or a bounce; they cast whole "
          "shadows "
          "of lights "
          "that are points, while by paths what skies and lamps send comes through, with more noise: " +
          grouped(static_cast<std::uint64_t>(count)));
    }
    if (pictures_.hidden_alphas() > 0) {
      result_.notes.push_back("textures whose alpha is not shown: " + grouped(pictures_.hidden_alphas()));
    }
  }

  /// Said where it may be too much, and on a terminal where it is much.
  void say_memory() const {
    constexpr std::uint64_t much = std::uint64_t{256} << 20U;
    const std::uint64_t bytes = estimated_reading_bytes(format_of(path_), file_bytes_);
    const std::string text =
        "dmpc: reading " + shown(path_) + " takes some " + bytes_text(bytes) + " of memory (half to twice that)";
    if (const AvailableMemory room = available_memory(); bytes > room.bytes) {
      std::cerr << text + ", and " + room.source + " is " + bytes_text(room.bytes) + '\n';
    } else if (bytes >= much && shows_progress_ && stderr_is_terminal()) {
      std::cerr << clear_line << text + '\n';  // in place of the progress, which comes again below
    }
  }

  void show(const Message& message) {
    const auto share = static_cast<double>(Unpacker(message.bytes).take<float>());
    const std::uint64_t total = std::max<std::uint64_t>(file_bytes_, 1);
    progress_.update(static_cast<std::uint64_t>((share >= 0 && share <= 1 ? share : 0) * static_cast<double>(total)), total);
  }

  std::string path_;
  MeshOptions options_;
  FileAccess access_;
  std::uint64_t file_bytes_ = 0;  ///< the scene's own
  bool shows_progress_ = false;
  Progress progress_;
  PictureReader pictures_;
  ReadingBudget budget_;  ///< covers the scene's own files and all requests for others
  ReaderProcess process_;
  SceneReceiver receiver_;
  std::string bytes_;     ///< the texture that is being sent
  bool can_copy_ = true;  ///< whether lists can be copied from the reader's memory
  std::uint64_t note_bytes_ = 0;
  MeshFile result_;
  std::string current_;  ///< the file opened last
};

}  // namespace

MeshFile read_in_session(const std::string& path, const MeshOptions& options, bool shows_progress, const ReaderLimits& limits) {
  return MeshSession(path, options, shows_progress, limits).read();
}

}  // namespace dmpc::apps
