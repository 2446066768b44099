// Layers beside a picture as files.
#pragma once

#include <filesystem>
#include <string>

#include "apps/picture/image_file.h"
#include "core/picture/film/film.h"
#include "core/picture/surfaces/layer.h"

namespace dmpc::apps {

struct LayerImage {
  core::Layer layer;
  Channels channels;  ///< albedo R, G, B; normal X, Y, Z, in -1 to 1; depth Z; id X
};

/// The numbers of a layer's film; requires samples > 0.
LayerImage layer_image(core::Layer layer, const core::Film& film);

/// Returns the bytes of the layer alone: of a path that ends in .exr the numbers; of others colours: albedo, (normal + 1) / 2,
/// the brighter the nearer, a colour by the number.
std::string layer_file(const std::filesystem::path& path, const LayerImage& image);

}  // namespace dmpc::apps
