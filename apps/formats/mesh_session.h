// Answers a mesh file's reader, and receives the scene.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "apps/formats/mesh_file.h"
#include "apps/formats/scene_blocks.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/stopwatch.h"
#include "apps/picture/picture_reader.h"
#include "apps/reader/file_access.h"
#include "apps/reader/process.h"

namespace dmpc::apps {

/// Opens the files that the scene may open, has its textures read, and trusts no message.
class MeshSession {
 public:
  /// Throws core::InputError if there is no file at `path`.
  MeshSession(const std::string& path, const MeshOptions& options, bool shows_progress, const ReaderLimits& limits);

  /// Throws core::InputError, with "PATH: ..." or the end of such a sentence.
  MeshFile read();

 private:
  void ask();
  /// Returns whether it was the last message.
  bool answer(const Message& message);
  /// Answers requests for files, within the budget.
  void answer_question(const Message& message);
  void refuse_if_missing(const std::function<void()>& act);
  void answer_open(const std::string& path);
  std::pair<InputFile, bool> open(const std::string& path);
  PictureFile open_picture(const std::string& path);
  void answer_meant(Unpacker fields);
  void answer_texture(const Message& message);
  PictureFile picture_of_file(Unpacker& fields);
  PictureFile picture_of_bytes(Unpacker& fields);
  void take_over(const Message& message);
  void spend(ProcessorStopwatch& stopwatch);
  void add_bytes(const Message& message);
  void add_sky(const Message& message);
  void take_bounds(const Message& message);
  void add_note(const Message& message);
  void note_alpha();
  void say_memory() const;
  void show(const Message& message);

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

}  // namespace dmpc::apps
