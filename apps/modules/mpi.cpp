// The module dmpc_mpi.so: frames, and the few steps that ranks take together, by MPI. Two-sided messages alone, and one call at
// a time: what every MPI does well.

#define OMPI_SKIP_MPICXX 1   // the C++ bindings, which MPI has given up
#define MPICH_SKIP_MPICXX 1  // no C++ bindings here either
#include <mpi.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/ranks/mpi_library.h"
#include "apps/frontend/system/module.h"
#include "core/base/expect.h"
#include "core/base/usual_arithmetic.h"
#include "nodes/ranks/backoff.h"
#include "nodes/ranks/fabric.h"

namespace dmpc::apps {
namespace {

constexpr int frame_tag = 0;
/// Frames that may have come before one is taken. Further ones wait at their senders.
constexpr std::size_t receives_posted = 32;

/// `done` is what an MPI function returned.
void check(int done, const char* what) {
  if (done != MPI_SUCCESS) {
    std::array<char, MPI_MAX_ERROR_STRING> text{};
    int length = 0;
    MPI_Error_string(done, text.data(), &length);
    throw nodes::LostRank(std::string("MPI cannot ") + what + ": " + std::string(text.data(), static_cast<std::size_t>(length)));
  }
}

/// True of what has never begun, too.
bool is_done(MPI_Request& request) {
  int flag = 0;
  check(MPI_Test(&request, &flag, MPI_STATUS_IGNORE), "complete what has begun");
  return flag != 0;
}

std::uint32_t rank() {
  int rank = 0;
  check(MPI_Comm_rank(MPI_COMM_WORLD, &rank), "tell which rank this is");
  return static_cast<std::uint32_t>(rank);
}

std::uint32_t rank_count() {
  int count = 0;
  check(MPI_Comm_size(MPI_COMM_WORLD, &count), "tell how many ranks there are");
  return static_cast<std::uint32_t>(count);
}

/// Receives are persistent, and tested in the order in which they were posted: messages are matched in that order, so that the
/// frames of each sender stay in theirs.
class MpiFabric final : public nodes::Fabric {
 public:
  MpiFabric(std::size_t frame_bytes, std::vector<std::string> names)
      : frame_bytes_(frame_bytes),
        rank_(apps::rank()),
        names_(std::move(names)),
        ways_(names_.size()),
        arrivals_(receives_posted * frame_bytes) {
    for (Way& way : ways_) {
      way.bytes.resize(way.requests.size() * frame_bytes);
    }
    receives_.fill(MPI_REQUEST_NULL);
    for (std::size_t i = 0; i < receives_.size(); ++i) {
      check(MPI_Recv_init(arrivals_.data() + i * frame_bytes, static_cast<int>(frame_bytes), MPI_BYTE, MPI_ANY_SOURCE, frame_tag,
                          MPI_COMM_WORLD, &receives_[i]),
            "set up a receive");
    }
    check(MPI_Startall(static_cast<int>(receives_.size()), receives_.data()), "begin to receive");
  }

  std::uint32_t rank() const override { return rank_; }
  std::uint32_t rank_count() const override { return static_cast<std::uint32_t>(names_.size()); }
  std::string name_of(std::uint32_t rank) const override { return names_.at(rank); }
  std::size_t frame_bytes() const override { return frame_bytes_; }
  std::size_t arrival_bytes() const override { return arrivals_.size(); }

  std::span<std::byte> room(std::uint32_t rank) override {
    Way& way = ways_[rank];
    return is_done(way.requests[way.next]) ? frame(way) : std::span<std::byte>();
  }

  void send(std::uint32_t rank, std::size_t bytes) override {
    Way& way = ways_[rank];
    check(MPI_Isend(frame(way).data(), static_cast<int>(bytes), MPI_BYTE, static_cast<int>(rank), frame_tag, MPI_COMM_WORLD,
                    &way.requests[way.next]),
          "send a frame");
    way.next = (way.next + 1) % way.requests.size();
  }

  std::optional<nodes::Arrival> take() override {
    give_back();
    int has_come = 0, bytes = 0;
    MPI_Status status;
    check(MPI_Test(&receives_[oldest_], &has_come, &status), "receive a frame");
    if (has_come == 0) {
      return std::nullopt;
    }
    is_held_ = true;
    check(MPI_Get_count(&status, MPI_BYTE, &bytes), "tell how long a frame is");
    return nodes::Arrival{static_cast<std::uint32_t>(status.MPI_SOURCE),
                          std::span(arrivals_).subspan(oldest_ * frame_bytes_, static_cast<std::size_t>(bytes))};
  }

  /// All that was sent has left its room.
  bool has_sent_all() {
    return std::all_of(ways_.begin(), ways_.end(),
                       [](Way& way) { return std::all_of(way.requests.begin(), way.requests.end(), is_done); });
  }

  /// Nothing is sent or taken any more.
  void close() {
    give_back();
    for (MPI_Request& receive : receives_) {
      check(MPI_Cancel(&receive), "give up a receive");
      check(MPI_Wait(&receive, MPI_STATUS_IGNORE), "give up a receive");
      check(MPI_Request_free(&receive), "give up a receive");
    }
  }

 private:
  /// To another rank: two frames, sent in turn.
  struct Way {
    std::array<MPI_Request, 2> requests{MPI_REQUEST_NULL, MPI_REQUEST_NULL};
    std::size_t next = 0;
    std::vector<std::byte> bytes;
  };

  std::span<std::byte> frame(Way& way) const { return std::span(way.bytes).subspan(way.next * frame_bytes_, frame_bytes_); }

  /// The frame that was taken last.
  void give_back() {
    if (is_held_) {
      is_held_ = false;
      check(MPI_Start(&receives_[oldest_]), "go on receiving");
      oldest_ = (oldest_ + 1) % receives_.size();
    }
  }

  std::size_t frame_bytes_;
  std::uint32_t rank_;
  std::vector<std::string> names_;
  std::vector<Way> ways_;  ///< by rank, this one included
  std::vector<std::byte> arrivals_;
  std::array<MPI_Request, receives_posted> receives_;
  std::size_t oldest_ = 0;  ///< oldest receive
  bool is_held_ = false;    ///< the frame of the oldest one
};

/// MPI is a process's own, and so is this.
std::optional<MpiFabric> fabric;

std::string version() {
  std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
  int length = 0;
  MPI_Get_library_version(text.data(), &length);
  std::string first(text.data(), static_cast<std::size_t>(length));
  first.erase(std::min(first.find_first_of(",\n"), first.size()));
  if (const std::size_t word = first.find(" Version:\t"); word != std::string::npos) {  // MPICH has a table of it
    first.replace(word, std::string(" Version:\t").size(), " ");
  }
  return first;
}

void start() {
  int given = MPI_THREAD_SINGLE;
  check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &given), "start");
  core::use_usual_arithmetic();  // it has loaded what it is made of
  check(MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN), "report errors");
  if (given < MPI_THREAD_SERIALIZED) {
    throw nodes::LostRank(version() + " allows calls of one thread alone: use one that was built for several");
  }
}

std::string host() {
  std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
  int length = 0;
  check(MPI_Get_processor_name(name.data(), &length), "tell the name of this computer");
  return {name.data(), static_cast<std::size_t>(length)};
}

std::vector<std::string> exchange(const std::string& own) {
  const int own_bytes = static_cast<int>(own.size());
  std::vector<int> bytes(rank_count()), offsets(bytes.size());
  check(MPI_Allgather(&own_bytes, 1, MPI_INT, bytes.data(), 1, MPI_INT, MPI_COMM_WORLD), "exchange words");
  std::exclusive_scan(bytes.begin(), bytes.end(), offsets.begin(), 0);
  std::string all(static_cast<std::size_t>(offsets.back() + bytes.back()), '\0');
  check(MPI_Allgatherv(own.data(), own_bytes, MPI_CHAR, all.data(), bytes.data(), offsets.data(), MPI_CHAR, MPI_COMM_WORLD),
        "exchange words");
  std::vector<std::string> words;
  for (std::size_t rank = 0; rank < bytes.size(); ++rank) {
    words.push_back(all.substr(static_cast<std::size_t>(offsets[rank]), static_cast<std::size_t>(bytes[rank])));
  }
  return words;
}

nodes::Fabric& make_fabric(std::size_t frame_bytes, const std::vector<std::string>& names) {
  core::expect(!fabric, "there is one fabric");
  return fabric.emplace(frame_bytes, names);
}

/// Takes and drops what comes, as its senders wait for that, until is_over() or the time is over; returns whether it is.
template <class IsOver>
bool drop_until(std::chrono::steady_clock::time_point end, const IsOver& is_over) {
  nodes::Backoff backoff;
  while (!is_over()) {
    if (std::chrono::steady_clock::now() > end) {
      return false;
    }
    if (fabric && fabric->take()) {
      backoff.end();
      continue;
    }
    const timespec time{.tv_sec = 0, .tv_nsec = backoff.next().count()};
    ::nanosleep(&time, nullptr);
  }
  return true;
}

bool finish(std::chrono::milliseconds timeout) {
  const auto end = std::chrono::steady_clock::now() + timeout;
  if (!drop_until(end, [] { return !fabric || fabric->has_sent_all(); })) {
    return false;
  }
  MPI_Request are_all_here = MPI_REQUEST_NULL;
  check(MPI_Ibarrier(MPI_COMM_WORLD, &are_all_here), "wait for the other ranks");
  if (!drop_until(end, [&] { return is_done(are_all_here); })) {
    return false;
  }
  if (fabric) {
    fabric->close();
  }
  return MPI_Finalize() == MPI_SUCCESS;
}

void abort(int status) { MPI_Abort(MPI_COMM_WORLD, status); }

constexpr MpiLibrary library{
    .version = version,
    .start = start,
    .rank = rank,
    .rank_count = rank_count,
    .host = host,
    .exchange = exchange,
    .make_fabric = make_fabric,
    .finish = finish,
    .abort = abort,
};

}  // namespace
}  // namespace dmpc::apps

extern "C" __attribute__((visibility("default"))) const dmpc::apps::Module dmpc_module{DMPC_MODULES_BUILD, &dmpc::apps::library};
