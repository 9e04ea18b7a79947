// The MTL reader: materials with finite numbers, none of which names a file (no folder is allowed here), or an error
// with a place.
#include "renderer/scene/mtl_reader.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace moonshade;
  const renderer::MtlReading mtl = renderer::parse_mtl("fuzz.mtl", fuzz::text_of(data, size), renderer::Folders());
  if (!mtl.error.empty()) {
    fuzz::require(mtl.error.starts_with("fuzz.mtl:"), "an error without its place: " + mtl.error);
    return 0;
  }
  for (const renderer::Material& material : mtl.materials) {
    fuzz::require(material.shader.empty() && material.height_shader.empty(), "a file outside the folders");
    for (const std::string& file : material.shaders)
      fuzz::require(file.empty(), "a file outside the folders");
    for (const auto& value : material.values)
      fuzz::require(!value || renderer::is_finite(*value), "a number that is not finite");
  }
  return 0;
}
