// Scenes for programs that render in a way of their own: a database of records in pages, and pixels that look them up. Beside
// <dmpc/pages.h>, whose words it uses, it needs no other header of dmpc's.
#pragma once

#include <dmpc/pages.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dmpc {

/// A page from Pages::find() that is given to a pixel must be readable for this many bytes behind its end; their values do not
/// matter.
inline constexpr std::size_t overread_bytes = 32;

/// A scene and a picture of it, one sample a pixel. Never changes: the programs of nodes may refer to it for what is no record.
class Scene {
 public:
  /// A built-in one, such as "rings-3-t1", in pages of a power of two from 512 B to 64 KiB. Throws UsageError for anything else.
  Scene(const std::string& name, std::uint32_t width, std::uint32_t height, std::size_t page_bytes = 1024);

  std::uint32_t pixel_count() const;
  std::size_t page_bytes() const;
  std::uint32_t page_count() const;
  /// All pages, one behind the other, and overread_bytes more that can be read.
  std::span<const std::byte> records() const;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

/// What a pixel's work is charged as, with prices on a core of today: the operations 0 .. scene_operation_count - 1 of a program
/// that renders, which may have others behind them.
std::vector<OperationNeed> scene_operations();
inline constexpr Index scene_operation_count = 8;

/// What a pixel's rays bring, in units that can be added in any order.
struct Light {
  std::array<std::int64_t, 6> sums{};
};

/// Renders one pixel after the other, depth first.
class PixelTask {
 public:
  /// Lies in `memory`, of memory_bytes(scene), as Node::allocate() gives it. The scene outlives it.
  PixelTask(const Scene& scene, std::span<std::byte> memory);
  static std::size_t memory_bytes(const Scene& scene);
  /// In memory that is no node's, for what is done before the start.
  explicit PixelTask(const Scene& scene);

  void start(std::uint32_t pixel);
  /// Traces one ray, or goes on with it. One page at a time is enough to come to the end.
  Step run(Pages& pages);
  /// The light of the pixel that has finished.
  Light light() const;

 private:
  struct State;
  PixelTask(const Scene& scene, std::shared_ptr<std::byte[]> memory);

  const Scene* scene_;
  std::shared_ptr<std::byte[]> own_;  ///< if it is no node's
  State* state_;
};

/// The picture that pixels add up to.
class Picture {
 public:
  explicit Picture(const Scene& scene);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  void put(std::uint32_t pixel, const Light& light);
  /// 16 digits: the film_hash that `dmpc render --stats` has of the same picture.
  std::string hash() const;

 private:
  struct Film;
  std::unique_ptr<Film> film_;
};

}  // namespace dmpc
