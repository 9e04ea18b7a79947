// tinygltf reads the structure; every index, offset and count in it is checked here before it is used.
#include "renderer/scene/gltf_reader.h"

#include <charconv>
#include <cstring>
#include <exception>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <tiny_gltf.h>

namespace moonshade::renderer {

namespace {

/// Thrown within this file only: the reader's parts are many, and each may find that the file is at fault.
struct GltfError {
  std::string message;
};
[[noreturn]] void fail(const std::string& message) { throw GltfError{message}; }

std::string numbered(const char* what, size_t index) { return std::string(what) + " " + std::to_string(index); }

/// Elements of an array that an index of the file names.
template <typename T> const T& at(const std::vector<T>& items, int index, const std::string& what) {
  if (index < 0 || size_t(index) >= items.size()) fail(what + " is missing");
  return items[size_t(index)];
}

class GltfReader {
public:
  GltfReader(const std::string& path, const tinygltf::Model& gltf, const Folders& folders)
      : path_(path), gltf_(gltf), folders_(folders) {
    for (const tinygltf::Buffer& buffer : gltf_.buffers)
      elements_left_ += 8 * uint64_t(buffer.data.size());
  }
  Model read();

private:
  struct Bytes {
    const unsigned char* begin;
    size_t stride;
  };
  Bytes bytes_of(int view, size_t offset, size_t count, size_t size, int stride, const std::string& what) const;
  std::vector<float> floats(int accessor, size_t components, const std::string& what) const;
  void afford(size_t elements, const std::string& what);
  void sparse(const tinygltf::Accessor& accessor, std::vector<float>& values, size_t components,
              const std::string& what) const;
  std::vector<uint32_t> indices(const tinygltf::Primitive& primitive, size_t vertices, const std::string& what) const;
  std::shared_ptr<const Mesh> mesh(const tinygltf::Primitive& primitive, const std::string& what);
  void materials();
  bool open(const std::string& material, const char* use, int texture, int coordinates,
            const tinygltf::ExtensionMap& extensions, SlotImage& image);
  void image(Material& material, Slot slot, const tinygltf::TextureInfo& info, SlotImage::Part part);
  void normals(Material& material, const tinygltf::NormalTextureInfo& info);
  std::string find_image(int index, SlotImage& image);
  void transform(const tinygltf::ExtensionMap& extensions, const std::string& what, SlotImage& image);
  void warn_of_what_is_passed_over();
  void nodes();
  void place(const tinygltf::Node& node, const Mat4& to_world, size_t index);
  void warn(const std::string& text) { model_.warnings.push_back(path_ + ": " + text); }

  const std::string& path_;
  const tinygltf::Model& gltf_;
  const Folders& folders_;
  Model model_;
  uint64_t elements_left_ = uint64_t(1) << 25; ///< that primitives may read, which may share what they read
  std::map<std::pair<int, size_t>, std::shared_ptr<const Mesh>> meshes_; ///< by mesh and primitive
  std::map<int, std::shared_ptr<const std::string>> image_bytes_;        ///< by image: kept once
};

GltfReader::Bytes GltfReader::bytes_of(int view_index, size_t offset, size_t count, size_t size, int stride,
                                       const std::string& what) const {
  const tinygltf::BufferView& view = at(gltf_.bufferViews, view_index, "the buffer view of " + what);
  const tinygltf::Buffer& buffer = at(gltf_.buffers, view.buffer, "the buffer of " + what);
  size_t step = stride > 0 ? size_t(stride) : view.byteStride > 0 ? view.byteStride : size;
  // Each term is checked alone: sums of hostile numbers wrap around.
  size_t available = std::min(view.byteLength, buffer.data.size() - std::min(buffer.data.size(), view.byteOffset));
  bool fits = view.byteOffset <= buffer.data.size() && offset <= available && size <= available - offset &&
              step >= size && (count <= 1 || (count - 1) <= (available - offset - size) / step);
  if (!fits || count == 0) fail(what + " reaches beyond its buffer");
  return {buffer.data.data() + view.byteOffset + offset, step};
}

double component(const unsigned char* bytes, int type, bool normalized, const std::string& what) {
  auto integer = [&](auto value) {
    std::memcpy(&value, bytes, sizeof value);
    double top = double(std::numeric_limits<decltype(value)>::max());
    return normalized ? std::max(double(value) / top, -1.0) : double(value);
  };
  float number = 0;
  switch (type) {
  case TINYGLTF_COMPONENT_TYPE_FLOAT:
    std::memcpy(&number, bytes, sizeof number);
    return double(number);
  case TINYGLTF_COMPONENT_TYPE_BYTE:
    return integer(int8_t());
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
    return integer(uint8_t());
  case TINYGLTF_COMPONENT_TYPE_SHORT:
    return integer(int16_t());
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
    return integer(uint16_t());
  case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    return integer(uint32_t());
  default:
    fail(what + " has components of an unknown type");
  }
}

size_t component_size(int type, const std::string& what) {
  int size = tinygltf::GetComponentSizeInBytes(uint32_t(type));
  if (size <= 0 || size > 4) fail(what + " has components of an unknown type");
  return size_t(size);
}

/// However many primitives read the same bytes: what a file comes to is bounded by its size.
void GltfReader::afford(size_t elements, const std::string& what) {
  if (elements > elements_left_) fail(what + ": the primitives come to too many elements for the size of the file");
  elements_left_ -= elements;
}

/// Values that stand in place of others (or of zeros).
void GltfReader::sparse(const tinygltf::Accessor& accessor, std::vector<float>& values, size_t components,
                        const std::string& what) const {
  const auto& s = accessor.sparse;
  if (s.count <= 0 || s.indices.byteOffset < 0 || s.values.byteOffset < 0) fail(what + " has a strange sparse part");
  size_t index_size = component_size(s.indices.componentType, what);
  size_t size = component_size(accessor.componentType, what);
  Bytes at = bytes_of(s.indices.bufferView, size_t(s.indices.byteOffset), size_t(s.count), index_size, 0, what);
  Bytes from = bytes_of(s.values.bufferView, size_t(s.values.byteOffset), size_t(s.count), size * components, 0, what);
  for (size_t k = 0; k < size_t(s.count); ++k) {
    double index = component(at.begin + k * at.stride, s.indices.componentType, false, what);
    if (!(index >= 0 && index < double(accessor.count))) fail(what + " has a strange sparse part");
    for (size_t c = 0; c < components; ++c)
      values[size_t(index) * components + c] =
          float(component(from.begin + k * from.stride + c * size, accessor.componentType, accessor.normalized, what));
  }
}

std::vector<float> GltfReader::floats(int index, size_t components, const std::string& what) const {
  const tinygltf::Accessor& accessor = at(gltf_.accessors, index, "the accessor of " + what);
  if (tinygltf::GetNumComponentsInType(uint32_t(accessor.type)) != int(components))
    fail(what + " has not " + std::to_string(components) + " components");
  if (accessor.count >= Mesh::kNoIndex) fail(what + " has too many elements");
  if (accessor.bufferView < 0 && !accessor.sparse.isSparse) fail(what + " has no data");
  size_t size = component_size(accessor.componentType, what);
  std::vector<float> values;
  if (accessor.bufferView >= 0) {
    Bytes bytes = bytes_of(accessor.bufferView, accessor.byteOffset, accessor.count, size * components, 0, what);
    values.reserve(accessor.count * components);
    for (size_t k = 0; k < accessor.count; ++k)
      for (size_t c = 0; c < components; ++c)
        values.push_back(float(
            component(bytes.begin + k * bytes.stride + c * size, accessor.componentType, accessor.normalized, what)));
  } else {
    constexpr size_t kMostZeros = 10'000'000; // which cost the file nothing
    if (accessor.count > kMostZeros) fail(what + " has too many elements without data");
    values.resize(accessor.count * components);
  }
  if (accessor.sparse.isSparse) sparse(accessor, values, components, what);
  return values;
}

std::vector<uint32_t> GltfReader::indices(const tinygltf::Primitive& primitive, size_t vertices,
                                          const std::string& what) const {
  std::vector<uint32_t> list;
  if (primitive.indices < 0) {
    for (uint32_t k = 0; k < vertices; ++k)
      list.push_back(k);
    return list;
  }
  const tinygltf::Accessor& accessor = at(gltf_.accessors, primitive.indices, "the accessor of " + what);
  const int type = accessor.componentType;
  const bool is_unsigned = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.type != TINYGLTF_TYPE_SCALAR || !is_unsigned) fail(what + " are no unsigned integers");
  size_t size = component_size(accessor.componentType, what);
  Bytes bytes = bytes_of(accessor.bufferView, accessor.byteOffset, accessor.count, size, 0, what);
  for (size_t k = 0; k < accessor.count; ++k)
    list.push_back(uint32_t(component(bytes.begin + k * bytes.stride, accessor.componentType, false, what)));
  return list;
}

std::shared_ptr<const Mesh> GltfReader::mesh(const tinygltf::Primitive& primitive, const std::string& what) {
  int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
  if (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_TRIANGLE_STRIP && mode != TINYGLTF_MODE_TRIANGLE_FAN) {
    warn(what + ": points and lines are passed over");
    return nullptr;
  }
  if (primitive.extensions.count("KHR_draco_mesh_compression")) fail(what + ": is compressed by Draco");
  if (!primitive.targets.empty()) warn(what + ": morph targets are passed over");
  auto attribute = [&](const char* name) {
    auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
  };
  if (attribute("POSITION") < 0) fail(what + ": has no positions");
  MeshBuilder builder;
  std::vector<float> p = floats(attribute("POSITION"), 3, what + ": POSITION");
  size_t vertices = p.size() / 3;
  afford(vertices, what);
  for (size_t k = 0; k < vertices; ++k)
    builder.positions().emplace_back(p[3 * k], p[3 * k + 1], p[3 * k + 2]);
  if (attribute("NORMAL") >= 0) {
    std::vector<float> n = floats(attribute("NORMAL"), 3, what + ": NORMAL");
    if (n.size() != p.size()) fail(what + ": has not as many normals as positions");
    for (size_t k = 0; k < vertices; ++k)
      builder.normals().emplace_back(n[3 * k], n[3 * k + 1], n[3 * k + 2]);
  }
  if (attribute("TEXCOORD_0") >= 0) {
    std::vector<float> uv = floats(attribute("TEXCOORD_0"), 2, what + ": TEXCOORD_0");
    if (uv.size() != 2 * vertices) fail(what + ": has not as many texture coordinates as positions");
    for (size_t k = 0; k < vertices; ++k)
      builder.uvs().emplace_back(uv[2 * k], 1 - uv[2 * k + 1]); // v points up here, down there
  }
  std::vector<uint32_t> list = indices(primitive, vertices, what + ": indices");
  afford(list.size(), what);
  size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
  for (size_t k = 0; k + 2 < list.size(); k += step) {
    bool turned = mode == TINYGLTF_MODE_TRIANGLE_STRIP && k % 2 == 1;
    uint32_t first = mode == TINYGLTF_MODE_TRIANGLE_FAN ? list[0] : list[k];
    const uint32_t corners[3] = {first, list[turned ? k + 2 : k + 1], list[turned ? k + 1 : k + 2]};
    if (std::string error = builder.face(corners); !error.empty()) fail(std::string(what).append(": ").append(error));
  }
  std::vector<std::string> warnings;
  auto made = builder.finish(path_ + ": " + what, warnings);
  model_.warnings.insert(model_.warnings.end(), warnings.begin(), warnings.end());
  return made;
}

double extension_number(const tinygltf::ExtensionMap& extensions, const char* extension, const char* name,
                        double otherwise) {
  auto found = extensions.find(extension);
  if (found == extensions.end() || !found->second.IsObject() || !found->second.Has(name)) return otherwise;
  const tinygltf::Value& value = found->second.Get(name);
  double number = value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
  return std::isfinite(number) ? number : otherwise;
}

/// "wood%20grain.png" as a file's name.
std::string percent_decoded(const std::string& uri) {
  std::string name;
  for (size_t k = 0; k < uri.size(); ++k) {
    unsigned byte = 0;
    const char* digits = uri.data() + k + 1;
    if (uri[k] == '%' && k + 2 < uri.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      name += char(byte);
      k += 2;
    } else {
      name += uri[k];
    }
  }
  return name;
}

/// The file or the bytes of an image; what is wrong with it.
std::string GltfReader::find_image(int index, SlotImage& image) {
  if (index < 0 || size_t(index) >= gltf_.images.size()) return "it is not there, or in no form that is read";
  const tinygltf::Image& source = gltf_.images[size_t(index)];
  image.name = source.uri.empty() ? numbered("image", size_t(index)) : percent_decoded(source.uri);
  if (!source.uri.empty()) {
    ResolvedPath file = folders_.resolve(folder_of(path_), source.uri);
    if (!file.error.empty()) file = folders_.resolve(folder_of(path_), image.name);
    image.file = file.path;
    return file.error;
  }
  auto& bytes = image_bytes_[index];
  if (!bytes && source.bufferView < 0)
    bytes = std::make_shared<const std::string>(source.image.begin(), source.image.end());
  if (!bytes) {
    if (size_t(source.bufferView) >= gltf_.bufferViews.size()) return "its buffer view is missing";
    const size_t size = gltf_.bufferViews[size_t(source.bufferView)].byteLength;
    try {
      const Bytes view = bytes_of(source.bufferView, 0, 1, size, int(std::min(size, size_t(INT32_MAX))), image.name);
      bytes = std::make_shared<const std::string>(reinterpret_cast<const char*>(view.begin), size);
    } catch (const GltfError& fault) {
      return fault.message;
    }
  }
  image.bytes = bytes;
  return "";
}

/// KHR_texture_transform, whose v points down.
void GltfReader::transform(const tinygltf::ExtensionMap& extensions, const std::string& what, SlotImage& image) {
  const auto found = extensions.find("KHR_texture_transform");
  if (found == extensions.end() || !found->second.IsObject()) return;
  auto pair = [&](const char* name, Vec2 otherwise) {
    const tinygltf::Value& list = found->second.Get(name);
    for (int k = 0; k < 2 && list.IsArray() && size_t(k) < list.ArrayLen(); ++k)
      if (list.Get(k).IsNumber() && std::abs(list.Get(k).GetNumberAsDouble()) < 1e9)
        otherwise[k] = float(list.Get(k).GetNumberAsDouble());
    return otherwise;
  };
  const Vec2 offset = pair("offset", Vec2(0));
  image.scale = pair("scale", Vec2(1));
  image.offset = Vec2(offset.x, 1 - offset.y - image.scale.y);
  if (extension_number(extensions, "KHR_texture_transform", "rotation", 0) != 0)
    warn(what + "the rotation of an image is passed over");
}

/// The image of a material's texture for some `use`; false, with a warning, where it cannot be shown.
bool GltfReader::open(const std::string& material, const char* use, int texture, int coordinates,
                      const tinygltf::ExtensionMap& extensions, SlotImage& image) {
  image.place = path_;
  const std::string what = "the material '" + material + "': ";
  const bool known = texture >= 0 && size_t(texture) < gltf_.textures.size();
  std::string error = find_image(known ? gltf_.textures[size_t(texture)].source : -1, image);
  if (error.empty() && coordinates != 0) error = "it has texture coordinates of its own, which are not read";
  if (!error.empty()) {
    const std::string name = image.name.empty() ? "" : " '" + image.name + "'";
    warn(what + "the image" + name + " of its " + use + " is not shown: " + error);
    return false;
  }
  transform(extensions, what, image);
  return true;
}

/// What the slot has so far is the factor, and stands in for an image that cannot be shown.
void GltfReader::image(Material& material, Slot slot, const tinygltf::TextureInfo& info, SlotImage::Part part) {
  if (info.index < 0) return;
  SlotImage image;
  image.part = part;
  image.factor = material.values[size_t(slot)].value_or(slot_infos()[size_t(slot)].default_value);
  if (open(material.name, slot_infos()[size_t(slot)].name, info.index, info.texCoord, info.extensions, image))
    material.images[size_t(slot)] = std::move(image);
  else if (slot == Slot::Emission)
    material.values[size_t(slot)] = Vec3(0);
}

void GltfReader::normals(Material& material, const tinygltf::NormalTextureInfo& info) {
  if (info.index < 0) return;
  SlotImage image;
  image.factor = Vec3(std::abs(info.scale) < 1e9 ? float(info.scale) : 1.0f);
  if (open(material.name, "normals", info.index, info.texCoord, info.extensions, image))
    material.bump_image = BumpImage{std::move(image), BumpImage::Kind::Normals};
}

void GltfReader::materials() {
  Material standard;
  standard.name = "default";
  standard.place = path_;
  model_.materials.push_back(standard);
  for (size_t k = 0; k < gltf_.materials.size(); ++k) {
    const tinygltf::Material& source = gltf_.materials[k];
    const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
    Material m;
    m.name = source.name.empty() ? "material" + std::to_string(k) : source.name;
    m.place = path_;
    auto number = [](double value, double low, double high) {
      return Vec3(float(std::isfinite(value) ? std::clamp(value, low, high) : low));
    };
    auto color = [&](const std::vector<double>& list, double most) {
      Vec3 c(0);
      for (size_t i = 0; i < 3 && i < list.size(); ++i)
        c[int(i)] = number(list[i], 0, most).x;
      return c;
    };
    m.values[size_t(Slot::Color)] = color(pbr.baseColorFactor, 1);
    m.values[size_t(Slot::Metallic)] = number(pbr.metallicFactor, 0, 1);
    m.values[size_t(Slot::Roughness)] = number(pbr.roughnessFactor, 0, 1); // squared, as ours
    double strength = extension_number(source.extensions, "KHR_materials_emissive_strength", "emissiveStrength", 1);
    m.values[size_t(Slot::Emission)] = color(source.emissiveFactor, 1) * number(strength, 0, 1e9).x;
    m.values[size_t(Slot::Ior)] = number(extension_number(source.extensions, "KHR_materials_ior", "ior", 1.5), 1, 100);
    m.values[size_t(Slot::Transmission)] =
        number(extension_number(source.extensions, "KHR_materials_transmission", "transmissionFactor", 0), 0, 1);
    image(m, Slot::Color, pbr.baseColorTexture, SlotImage::Part::Red);
    image(m, Slot::Metallic, pbr.metallicRoughnessTexture, SlotImage::Part::Blue);
    image(m, Slot::Roughness, pbr.metallicRoughnessTexture, SlotImage::Part::Green);
    image(m, Slot::Emission, source.emissiveTexture, SlotImage::Part::Red);
    if (source.alphaMode == "BLEND" || source.alphaMode == "MASK") {
      auto& opacity = m.values[size_t(Slot::Opacity)];
      auto& alpha = m.images[size_t(Slot::Opacity)];
      opacity = number(pbr.baseColorFactor.size() == 4 ? pbr.baseColorFactor[3] : 1, 0, 1);
      // The same image as the colour's, of which all that can be said has been.
      alpha = m.images[size_t(Slot::Color)];
      if (alpha) alpha->part = SlotImage::Part::Alpha, alpha->factor = *opacity;
      if (source.alphaMode == "MASK") {
        const float cutoff = number(source.alphaCutoff, 0, 1).x;
        if (alpha) alpha->cutoff = cutoff;
        opacity = Vec3(opacity->x >= cutoff ? 1.0f : 0.0f);
      }
    }
    normals(m, source.normalTexture);
    model_.materials.push_back(std::move(m));
  }
}

void GltfReader::warn_of_what_is_passed_over() {
  if (!gltf_.skins.empty()) warn("skins are passed over");
  if (!gltf_.animations.empty()) warn("animations are passed over");
}

Mat4 matrix_of(const tinygltf::Node& node, const std::string& what) {
  for (const auto* list : {&node.matrix, &node.translation, &node.rotation, &node.scale})
    for (double value : *list)
      if (!(std::abs(value) <= 1e15)) fail(what + ": its place is not finite");
  Mat4 m(1.0f);
  if (node.matrix.size() == 16) {
    for (int k = 0; k < 16; ++k)
      m[k / 4][k % 4] = float(node.matrix[size_t(k)]);
    return m;
  }
  if (node.translation.size() == 3)
    m = glm::translate(m, Vec3(node.translation[0], node.translation[1], node.translation[2]));
  if (node.rotation.size() == 4) {
    glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    double length = glm::length(q);
    if (length > 0) m *= Mat4(glm::mat4_cast(q / length));
  }
  if (node.scale.size() == 3) m = glm::scale(m, Vec3(node.scale[0], node.scale[1], node.scale[2]));
  return m;
}

void GltfReader::place(const tinygltf::Node& node, const Mat4& to_world, size_t index) {
  if (node.mesh < 0) return;
  const tinygltf::Mesh& source = at(gltf_.meshes, node.mesh, "the mesh of " + numbered("node", index));
  double determinant = glm::determinant(DMat3(to_world));
  if (determinant == 0 || !std::isfinite(determinant))
    return warn(numbered("node", index) + ": has no extent and is skipped");
  for (size_t k = 0; k < source.primitives.size(); ++k) {
    auto [made, is_new] = meshes_.try_emplace({node.mesh, k});
    std::string what = numbered("mesh", size_t(node.mesh)) + ", " + numbered("primitive", k);
    if (is_new) made->second = mesh(source.primitives[k], what);
    if (!made->second) continue;
    Object object;
    object.name = node.name.empty() ? source.name : node.name;
    if (object.name.empty()) object.name = numbered("node", index);
    object.mesh = made->second;
    object.to_world = to_world;
    int material = source.primitives[k].material;
    if (material >= int(gltf_.materials.size())) fail("the material of " + what + " is missing");
    object.materials = {material < 0 ? 0 : uint32_t(material) + 1};
    model_.objects.push_back(std::move(object));
  }
}

/// Depth first, in the file's order, without recursion: a file may be as deep as it is long.
void GltfReader::nodes() {
  std::vector<uint8_t> seen(gltf_.nodes.size()), is_child(gltf_.nodes.size());
  std::vector<std::pair<int, Mat4>> waiting;
  if (!gltf_.scenes.empty()) {
    const tinygltf::Scene& scene = at(gltf_.scenes, std::max(0, gltf_.defaultScene), "the default scene");
    for (size_t k = scene.nodes.size(); k-- > 0;)
      waiting.emplace_back(scene.nodes[k], Mat4(1.0f));
  } else {
    for (const tinygltf::Node& node : gltf_.nodes)
      for (int child : node.children)
        if (child >= 0 && size_t(child) < is_child.size()) is_child[size_t(child)] = 1;
    for (size_t k = gltf_.nodes.size(); k-- > 0;)
      if (!is_child[k]) waiting.emplace_back(int(k), Mat4(1.0f));
  }
  while (!waiting.empty()) {
    auto [index, to_world] = waiting.back();
    waiting.pop_back();
    const tinygltf::Node& node = at(gltf_.nodes, index, numbered("node", size_t(index)));
    if (seen[size_t(index)]++) fail(numbered("node", size_t(index)) + " has two parents, or is its own");
    Mat4 here = to_world * matrix_of(node, numbered("node", size_t(index)));
    place(node, here, size_t(index));
    for (size_t k = node.children.size(); k-- > 0;)
      waiting.emplace_back(node.children[k], here);
  }
}

Model GltfReader::read() {
  materials();
  warn_of_what_is_passed_over();
  nodes();
  if (model_.objects.empty()) fail("has no triangles");
  return std::move(model_);
}

// What tinygltf may open: buffers in the folders of the scene. Images are opened when the scene is prepared.
struct Files {
  const Folders* folders;
  std::string base;
};

std::string resolved(const std::string& name, void* user) {
  const auto& files = *static_cast<const Files*>(user);
  std::string ending = std::filesystem::path(name).extension().string();
  if (ending != ".bin" && ending != ".glbin" && ending != ".glbuf") return "";
  return files.folders->resolve(files.base, name).path;
}

tinygltf::FsCallbacks callbacks(Files& files) {
  tinygltf::FsCallbacks calls{};
  calls.FileExists = [](const std::string& name, void* user) { return !resolved(name, user).empty(); };
  calls.ExpandFilePath = [](const std::string& name, void*) { return name; };
  calls.ReadWholeFile = [](std::vector<unsigned char>* out, std::string* error, const std::string& name, void* user) {
    FileText file = read_file(resolved(name, user));
    if (!file.error.empty() && error) *error += file.error + "\n";
    out->assign(file.text.begin(), file.text.end());
    return file.error.empty();
  };
  calls.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
  };
  calls.user_data = &files;
  return calls;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

} // namespace

Model parse_gltf(const std::string& path, std::string_view bytes, const Folders& folders) {
  Model model;
  Files files{&folders, folder_of(path)};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(callbacks(files));
  loader.SetImageLoader(
      [](tinygltf::Image* image, const int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
         void*) {
        // Within a URI; the others have a place where their bytes are found.
        if (image->uri.empty() && image->bufferView < 0) image->image.assign(bytes, bytes + size);
        return true;
      },
      nullptr);
  tinygltf::Model gltf;
  std::string error, warnings;
  if (bytes.size() >= size_t(INT32_MAX)) return model.error = path + ": larger than two gigabytes", model;
  // The library may throw on what it does not expect; nothing of that leaves this function.
  try {
    bool binary = bytes.starts_with("glTF");
    bool ok = binary ? loader.LoadBinaryFromMemory(&gltf, &error, &warnings,
                                                   reinterpret_cast<const unsigned char*>(bytes.data()),
                                                   unsigned(bytes.size()), "")
                     : loader.LoadASCIIFromString(&gltf, &error, &warnings, bytes.data(), unsigned(bytes.size()), "");
    if (!ok) return model.error = path + ": " + (error.empty() ? "is no glTF" : first_line(error)), model;
    return GltfReader(path, gltf, folders).read();
  } catch (const GltfError& fault) {
    model.error = path + ": " + fault.message;
  } catch (const std::bad_alloc&) {
    model.error = path + ": takes too much memory";
  } catch (const std::exception& fault) {
    model.error = path + ": " + first_line(fault.what());
  }
  return model;
}

Model read_gltf(const std::string& path, const Folders& folders) {
  FileText file = read_file(path);
  Model model;
  if (!file.error.empty()) return model.error = file.error, model;
  return parse_gltf(path, file.text, folders);
}

} // namespace moonshade::renderer
