// What dmpc and the processes that read and write files for it say to each other: kinds of messages, each with its fields.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dmpc::apps {

/// The version of the messages and of what they hold; processes of different builds do not understand each other.
inline constexpr std::uint32_t protocol = 15;

/// A message is no longer; more is sent in pieces.
inline constexpr std::size_t message_bytes_max = 64 * 1024;
/// A text is cut off there.
inline constexpr std::size_t text_bytes_max = 32 * 1024;

/// Fields in the order in which they are packed (apps/reader/packing.h).
enum class Saying : std::uint8_t {
  // From dmpc.
  limits,     ///< bytes of memory: the first message
  read_mesh,  ///< path, bytes of memory for the scene, scale, up, smooth, size, flags of MeshOptions, and an animation's moment
              ///< if one is asked for
  read_texture,   ///< name, format hint, bytes of the file, whether alpha counts; with the file
  read_image,     ///< likewise
  weigh_picture,  ///< likewise; answered by picture and done, from what stands before the pixels
  writes,         ///< an ending; answered by yes or no
  write_picture,  ///< name, width, height, whether its values are floats; these follow as bytes; answered by bytes, then done
  file,           ///< bytes of the file; with the file
  names,          ///< paths
  yes,
  no,  ///< why not
  // From a reader.
  ready,          ///< protocol, what confines it: a flag each of Confinement
  open,           ///< path; answered by file or no
  exists,         ///< path; answered by yes or no
  meant,          ///< a folder and a name in the scene's file; answered by names
  progress,       ///< share, 0 to 1
  bytes,          ///< more of the picture that is talked of
  texture_file,   ///< whether it is but weighed, path, edges; answered by yes, when it is the scene's next texture, or no
  texture_bytes,  ///< number of bytes sent; the first time to be weighed: that, name, format hint, edges; answered likewise
  picture,        ///< width, height, format; its bytes follow, then done
  scene,          ///< view, background, counts of materials, objects, points, vertices, normals, corners, meshes and places
  lights,
  materials,
  objects,
  points,  ///< where vertices lie
  normals,
  corners,
  meshes,     ///< which of the objects stand in places of their own: core::SharedMesh
  places,     ///< instances of meshes: core::Instance
  vertices,   ///< indices of the points that have come
  note,       ///< a text
  done,       ///< the last message about what was asked for
  bad_input,  ///< a text
  no_room,    ///< a text
  out_of_memory,
  lies_here,  ///< objects, or another list of a scene's, address and bytes: answered by yes, when dmpc has them from there, or no
  spheres,    ///< if the scene has spheres
  sky,        ///< the last of all: a picture's path, the rows of what turns the world's directions into its own, a factor
  bounds,     ///< for an animation's moment: a centre and a radius
  left_to_another,  ///< the picture that is asked for: this program does not read it
};

}  // namespace dmpc::apps
