// The parts of build_scene(): one function per kind of thing, found by the description's indices.
#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>

#include "scene/build.h"
#include "textures/bitmap.h"
#include "textures/mesh_attribute.h"

namespace duet {

/// Makes the things that shapes and lights ask for, each once and none that nobody asks for. After
/// an error the maker returns null or nothing, so that the remaining errors are found too.
class SceneBuilder {
 public:
  SceneBuilder(SceneDescription description, const BuildOptions& options, Diagnostics& diagnostics);

  /// Null if there were errors.
  std::unique_ptr<Scene> build();

 private:
  using AttributeSet = std::set<MeshAttributeTexture*>;
  /// A texture or material that has been asked for: null after an error.
  template <class T>
  struct Made {
    const T* thing = nullptr;
    /// The textures within it that must know the meshes on which they are used.
    AttributeSet attributes;
  };

  // build_textures.cpp
  const Texture* texture(TextureId id);
  std::unique_ptr<Texture> make_texture(const BitmapTexture& t, const SourceLocation& where);
  std::unique_ptr<Texture> make_texture(const CheckerboardTexture& t, const SourceLocation& where);
  std::unique_ptr<Texture> make_texture(const MeshAttributeTextureDescription& t,
                                        const SourceLocation& where);
  std::shared_ptr<const BitmapPixels> pixels(const BitmapTexture& t, const SourceLocation& where);
};

}  // namespace duet
