// The mountain beyond the sizes of 1987.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/sampling.h"
#include "core/families/scenes.h"

namespace mount_test {

using namespace dmpc::core;

namespace {

/// The heights of all grid points, row by row.
class Heights {
 public:
  explicit Heights(int size) : side_((std::size_t{1} << static_cast<unsigned>(size)) + 1), heights_(side_ * side_) {
    for (const Vec3d& vertex : built_in_scene({.family = "mount", .size = size}).vertices) {
      heights_[index(vertex.y) * side_ + index(vertex.x)] = vertex.z;
    }
  }
  std::size_t side() const { return side_; }
  double at(std::size_t x, std::size_t y) const { return heights_[y * side_ + x]; }
  double lowest() const { return *std::min_element(heights_.begin(), heights_.end()); }
  double highest() const { return *std::max_element(heights_.begin(), heights_.end()); }

 private:
  std::size_t index(double coordinate) const {
    return static_cast<std::size_t>(std::lround((coordinate + 1) / 2 * static_cast<double>(side_ - 1)));
  }

  std::size_t side_;
  std::vector<double> heights_;
};

/// How far the points in the middles of the smallest squares' lower sides were displaced, row by row of as many.
std::vector<double> details(const Heights& heights) {
  std::vector<double> found;
  for (std::size_t y = 0; y < heights.side(); y += 2) {
    for (std::size_t x = 1; x < heights.side(); x += 2) {
      found.push_back(heights.at(x, y) - (heights.at(x - 1, y) + heights.at(x + 1, y)) / 2);
    }
  }
  return found;
}

/// The correlation of what is `distance` apart: 1 if alike, about 0 if unrelated.
double correlation(const std::vector<double>& values, std::size_t distance) {
  double products = 0, squares = 0;
  for (std::size_t i = 0; i + distance < values.size(); ++i) {
    products += values[i] * values[i + distance];
    squares += values[i] * values[i];
  }
  return products / squares;
}

/// The strongest between neighbours in a row, or in the eight rows above.
double strongest_correlation(const Heights& heights) {
  const std::vector<double> all = details(heights);
  const std::size_t row = (heights.side() - 1) / 2;
  double strongest = 0;
  for (std::size_t rows = 0; rows <= 8; ++rows) {
    for (std::size_t columns = 0; columns <= 8; ++columns) {
      strongest = rows + columns == 0 ? 0 : std::max(strongest, std::abs(correlation(all, rows * row + columns)));
    }
  }
  return strongest;
}

std::uint64_t digest(int size) {
  std::uint64_t hash = 0;
  for (const Vec3d& vertex : built_in_scene({.family = "mount", .size = size}).vertices) {
    for (const double coordinate : {vertex.x, vertex.y, vertex.z}) {
      hash = mix(hash ^ std::bit_cast<std::uint64_t>(coordinate));
    }
  }
  return hash;
}

}  // namespace

TEST_CASE("mountains of the sizes of 1987 are those of 1987 to the last bit") {
  CHECK(digest(1) == 18434656043571625421U);
  CHECK(digest(6) == 7290951919954394487U);
  CHECK(digest(7) == 14389631673404830731U);
}

TEST_CASE("a mountain has every point of the next smaller one, and more between") {
  for (int size = 1; size <= 8; ++size) {
    const Heights coarse(size), fine(size + 1);
    std::size_t different = 0;
    for (std::size_t y = 0; y < coarse.side(); ++y) {
      for (std::size_t x = 0; x < coarse.side(); ++x) {
        different += coarse.at(x, y) == fine.at(2 * x, 2 * y) ? 0 : 1;
      }
    }
    CHECK(different == 0);
  }
}

TEST_CASE("what a mountain has between the points of 1987 does not repeat itself") {
  for (const int size : {8, 9}) {
    CHECK(strongest_correlation(Heights(size)) < 0.05);
  }
  CHECK(strongest_correlation(Heights(7)) > 0.5);  // those of 1987 do
}

TEST_CASE("finer mountains are as high as that of 1987, and half as rough with each size") {
  const Heights old(7);
  const auto roughness = [](const Heights& heights) {
    double squares = 0;
    const std::vector<double> all = details(heights);
    for (const double detail : all) {
      squares += detail * detail;
    }
    return std::sqrt(squares / static_cast<double>(all.size()));
  };
  for (const int size : {8, 9}) {
    const Heights fine(size);
    CHECK(fine.highest() == doctest::Approx(old.highest()).epsilon(0.02));
    CHECK(fine.lowest() == doctest::Approx(old.lowest()).epsilon(0.05));
    CHECK(roughness(fine) == doctest::Approx(roughness(old) / std::pow(2, size - 7)).epsilon(0.1));
  }
}

}  // namespace mount_test
