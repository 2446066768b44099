// What Assimp says while it reads a file.
#pragma once

#include <string>
#include <vector>

namespace dmpc::apps {

/// While it lives, Assimp's warnings and errors are kept: most say what it leaves out, or puts in place of what it cannot read.
/// One thread alone may have one, since Assimp has one log.
class AssimpLog {
 public:
  AssimpLog();
  ~AssimpLog();
  AssimpLog(const AssimpLog&) = delete;
  AssimpLog& operator=(const AssimpLog&) = delete;

  /// Appends the first kinds, "Assimp says: WORDS: COUNT", and the number of all others. Words that differ in numbers and names
  /// alone are of one kind, and stand there as they came first.
  void note(std::vector<std::string>& notes) const;

 private:
  struct Collector;
  Collector* collector_;  ///< Assimp's
};

}  // namespace dmpc::apps
