// A stream buffer hands the file to tinyobjloader one line at a time. It keeps the number of the line in hand, joins
// continued lines, drops comments, and takes the statements that are no geometry (materials, smoothing groups) itself.
#include "renderer/scene/obj_reader.h"

#include "renderer/scene/mesh.h"
#include "renderer/scene/mtl_reader.h"

#include <charconv>
#include <istream>
#include <map>
#include <set>
#include <sstream>
#include <streambuf>
#include <tiny_obj_loader.h>

namespace moonshade::renderer {

namespace {

/// Lines of a text, ended by \n, \r\n or \r; a backslash at the end continues a line.
class Lines {
public:
  explicit Lines(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }
  bool next(std::string& line) {
    line.clear();
    if (at_ >= text_.size()) return false;
    number_ = next_number_;
    while (at_ < text_.size()) {
      size_t end = text_.find_first_of("\r\n", at_);
      if (end == std::string_view::npos) end = text_.size();
      std::string_view part = text_.substr(at_, end - at_);
      at_ = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1);
      ++next_number_;
      bool continued = part.ends_with('\\');
      line += continued ? part.substr(0, part.size() - 1) : part;
      if (!continued) break;
      line += ' ';
    }
    return true;
  }
  size_t number() const { return number_; }

private:
  std::string_view text_;
  size_t at_ = 0, number_ = 0, next_number_ = 1;
};

std::string_view first_word(std::string_view line) {
  size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return "";
  return line.substr(begin, line.find_first_of(" \t", begin) - begin);
}

std::string rest_of(std::string_view line) {
  size_t begin = line.find_first_not_of(" \t");
  begin = line.find_first_of(" \t", begin);
  if (begin == std::string_view::npos) return "";
  begin = line.find_first_not_of(" \t", begin);
  if (begin == std::string_view::npos) return "";
  return std::string(line.substr(begin, line.find_last_not_of(" \t") + 1 - begin));
}

enum class Numbers { Good, NotFinite, Malformed };

/// Are there at least `least` plain numbers behind the keyword? (tinyobjloader reads what is no number as zero.)
Numbers check_numbers(std::string_view line, size_t least) {
  size_t count = 0, at = line.find_first_not_of(" \t");
  at = line.find_first_of(" \t", at);
  while (at != std::string_view::npos && (at = line.find_first_not_of(" \t", at)) != std::string_view::npos) {
    size_t end = line.find_first_of(" \t", at);
    std::string_view word = line.substr(at, end - at);
    if (word.find_first_not_of("0123456789+-.eE") != std::string_view::npos) {
      bool not_finite = word.find_first_of("nNfF#") != std::string_view::npos;
      return not_finite ? Numbers::NotFinite : Numbers::Malformed;
    }
    ++count;
    at = end;
  }
  return count >= least ? Numbers::Good : Numbers::Malformed;
}

/// Reads one index of a corner, "" being none; false where it is no whole number that an int holds.
bool read_index(std::string_view text, int& index) {
  index = 0;
  if (text.empty()) return true;
  auto [end, error] = std::from_chars(text.data() + (text[0] == '+'), text.data() + text.size(), index);
  return error == std::errc() && end == text.data() + text.size();
}

/// Rewrites the corners of a face in the few forms that tinyobjloader reads without guessing; gives the corner that is
/// none of `v`, `v/t`, `v//n`, `v/t/n`.
std::string plain_corners(std::string& line) {
  std::string plain = "f";
  std::istringstream words(line);
  std::string word;
  for (words >> word; words >> word;) {
    int index[3] = {0, 0, 0};
    std::string_view rest = word;
    for (int k = 0; k < 3; ++k) {
      size_t end = std::min(rest.find('/'), rest.size());
      if (!read_index(rest.substr(0, end), index[k])) return word;
      if (end == rest.size()) {
        rest = "";
        break;
      }
      rest.remove_prefix(end + 1);
      if (k == 2) return word;
    }
    plain += ' ' + std::to_string(index[0]);
    if (index[1] || index[2]) plain += '/' + (index[1] ? std::to_string(index[1]) : "");
    if (index[2]) plain += '/' + std::to_string(index[2]);
  }
  line = std::move(plain);
  return "";
}

/// Squares and products of what lies farther out leave the range of floats.
constexpr float kFarthest = 1e15f;

/// Collects what the callbacks deliver.
class ObjBuilder {
public:
  ObjBuilder(const std::string& path, std::string_view text, const Folders& folders)
      : path_(path), folders_(folders), lines_(text) {
    reading_.mesh = std::make_shared<Mesh>();
    reading_.mesh->name = path;
  }

  /// The next line for tinyobjloader; false at the end or after an error.
  bool feed(std::string& line);
  void vertex(const Vec3& p) { mesh().positions.push_back(number_state_ == Numbers::Good ? p : Vec3(NAN)); }
  void normal(const Vec3& n) { mesh().normals.push_back(normalize_or(n, Vec3(0))); }
  void uv(const Vec2& t) { mesh().uvs.push_back(std::isfinite(t.x) && std::isfinite(t.y) ? t : Vec2(0)); }
  void face(const tinyobj::index_t* corners, size_t count);
  ObjReading finish();

private:
  Mesh& mesh() { return *reading_.mesh; }
  std::string place() const { return path_ + ":" + std::to_string(lines_.number()); }
  void fail(const std::string& message) {
    if (reading_.error.empty()) reading_.error = place() + ": " + message;
  }
  void warn(const std::string& message) {
    if (reading_.warnings.size() < 20) reading_.warnings.push_back(place() + ": " + message);
  }
  void check_geometry(const std::string& line, size_t least);
  bool resolve(int index, size_t count, const char* what, uint32_t& resolved);
  void smoothing(const std::string& group);
  void use_material(const std::string& name);
  void load_materials(const std::string& files);
  uint32_t slot_of_current_material();
  void add_triangle(const Mesh::Corners& p, const Mesh::Corners& t, const Mesh::Corners& n);

  std::string path_;
  const Folders& folders_;
  Lines lines_;
  ObjReading reading_;
  Numbers number_state_ = Numbers::Good;
  std::map<std::string, Material> library_;
  std::set<std::string> libraries_; ///< files that are read
  std::map<std::string, uint32_t> slots_;
  std::set<std::string> unknown_;
  std::string current_material_;
  uint32_t current_slot_ = Mesh::kNoIndex;
  uint32_t group_ = 0;
  bool smoothing_stated_ = false, has_free_forms_ = false;
  Smoothing smoothing_;
  size_t faces_ = 0, zero_area_ = 0, not_finite_ = 0, too_small_ = 0;
  // Of the face in hand.
  std::vector<Vec3> polygon_;
  std::vector<uint32_t> ids_, uv_ids_, normal_ids_;
  std::vector<Mesh::Corners> triangles_;
};

void ObjBuilder::check_geometry(const std::string& line, size_t least) {
  number_state_ = check_numbers(line, least);
  if (number_state_ == Numbers::Malformed) fail("expected at least " + std::to_string(least) + " numbers");
}

bool ObjBuilder::feed(std::string& line) {
  while (reading_.error.empty() && lines_.next(line)) {
    std::string_view word = first_word(line);
    if (word.empty() || word[0] == '#') continue;
    bool geometry = word == "v" || word == "vn" || word == "vt" || word == "f";
    if (geometry) {
      if (size_t comment = line.find('#'); comment != std::string::npos && line.find("1.#") == std::string::npos)
        line.resize(comment);
      if (word != "f")
        check_geometry(line, word == "vt" ? 1 : 3);
      else if (std::string wrong = plain_corners(line); !wrong.empty())
        fail("'" + wrong + "' is no corner of a face: expected v, v/t, v//n or v/t/n");
      if (reading_.error.empty()) return true;
    } else if (word == "usemtl") {
      use_material(rest_of(line));
    } else if (word == "mtllib") {
      load_materials(rest_of(line));
    } else if (word == "s") {
      smoothing(rest_of(line));
    } else if ((word == "curv" || word == "curv2" || word == "surf") && !has_free_forms_) {
      has_free_forms_ = true;
      warn("free-form curves and surfaces are passed over");
    }
  }
  return false;
}

void ObjBuilder::smoothing(const std::string& group) {
  smoothing_stated_ = true;
  group_ = group == "off" ? 0 : group == "on" ? 1 : uint32_t(std::strtoul(group.c_str(), nullptr, 10));
}

void ObjBuilder::load_materials(const std::string& files) {
  // The whole rest of the line is one name with blanks, or several names.
  std::vector<std::string> names;
  if (folders_.resolve_or_beside(folder_of(path_), files).error.empty()) {
    names.push_back(files);
  } else {
    std::istringstream words(files);
    for (std::string word; words >> word;)
      names.push_back(word);
  }
  for (const std::string& name : names) {
    ResolvedPath file = folders_.resolve_or_beside(folder_of(path_), name);
    if (!file.error.empty()) {
      warn(file.error + "; its materials are the default one");
      continue;
    }
    if (!libraries_.insert(file.path).second) continue; // what is read twice gives nothing new
    MtlReading mtl = read_mtl(file.path, folders_);
    for (std::string& warning : mtl.warnings)
      reading_.warnings.push_back(std::move(warning));
    if (!mtl.error.empty()) reading_.error = mtl.error;
    for (Material& material : mtl.materials)
      library_.try_emplace(material.name, std::move(material));
  }
}

void ObjBuilder::use_material(const std::string& name) {
  current_material_ = name;
  current_slot_ = Mesh::kNoIndex;
  if (!library_.contains(name) && unknown_.insert(name).second && !name.empty())
    warn("no material '" + name + "' has been read; the default one stands in");
}

uint32_t ObjBuilder::slot_of_current_material() {
  if (current_slot_ != Mesh::kNoIndex) return current_slot_;
  auto found = library_.find(current_material_);
  std::string key = found == library_.end() ? "" : current_material_;
  auto [slot, is_new] = slots_.try_emplace(key, uint32_t(reading_.materials.size()));
  if (is_new) {
    Material standin;
    standin.name = "default";
    standin.place = path_;
    reading_.materials.push_back(found == library_.end() ? standin : found->second);
  }
  return current_slot_ = slot->second;
}

bool ObjBuilder::resolve(int index, size_t count, const char* what, uint32_t& resolved) {
  int64_t position = index > 0 ? int64_t(index) - 1 : int64_t(count) + index;
  if (index != 0 && position >= 0 && position < int64_t(count)) {
    resolved = uint32_t(position);
    return true;
  }
  fail("the face names " + std::string(what) + " " + std::to_string(index) + ", but there are " +
       std::to_string(count) + " so far");
  return false;
}

void ObjBuilder::face(const tinyobj::index_t* corners, size_t count) {
  if (!reading_.error.empty()) return;
  ++faces_;
  if (count < 3) {
    ++too_small_;
    return;
  }
  polygon_.clear(), ids_.clear(), uv_ids_.clear(), normal_ids_.clear(), triangles_.clear();
  for (size_t i = 0; i < count; ++i) {
    uint32_t p = 0, t = Mesh::kNoIndex, n = Mesh::kNoIndex;
    if (!resolve(corners[i].vertex_index, mesh().positions.size(), "vertex", p)) return;
    int uv = corners[i].texcoord_index, normal = corners[i].normal_index;
    if (uv != 0 && !resolve(uv, mesh().uvs.size(), "texture coordinate", t)) return;
    if (normal != 0 && !resolve(normal, mesh().normals.size(), "normal", n)) return;
    if (n != Mesh::kNoIndex && is_black(mesh().normals[n])) n = Mesh::kNoIndex; // a zero normal is none
    if (!is_finite(mesh().positions[p])) {
      ++not_finite_;
      return;
    }
    if (max_component(glm::abs(mesh().positions[p])) > kFarthest)
      return fail("vertex " + std::to_string(p + 1) + " lies too far out; coordinates reach to 1e15");
    ids_.push_back(p), uv_ids_.push_back(t), normal_ids_.push_back(n);
    polygon_.push_back(mesh().positions[p]);
  }
  triangulate(polygon_, triangles_);
  for (const Mesh::Corners& t : triangles_)
    add_triangle({ids_[t[0]], ids_[t[1]], ids_[t[2]]}, {uv_ids_[t[0]], uv_ids_[t[1]], uv_ids_[t[2]]},
                 {normal_ids_[t[0]], normal_ids_[t[1]], normal_ids_[t[2]]});
}

void ObjBuilder::add_triangle(const Mesh::Corners& p, const Mesh::Corners& t, const Mesh::Corners& n) {
  DVec3 a(mesh().positions[p[0]]), b(mesh().positions[p[1]]), c(mesh().positions[p[2]]);
  DVec3 area = glm::cross(b - a, c - a);
  if (!(glm::dot(area, area) > 0)) {
    ++zero_area_;
    return;
  }
  mesh().triangles.push_back(p);
  mesh().uv_corners.push_back(t);
  bool has_normals = n[0] != Mesh::kNoIndex && n[1] != Mesh::kNoIndex && n[2] != Mesh::kNoIndex;
  mesh().normal_corners.push_back(has_normals ? n : Mesh::Corners{Mesh::kNoIndex, Mesh::kNoIndex, Mesh::kNoIndex});
  mesh().material_slots.push_back(slot_of_current_material());
  smoothing_.groups.push_back(group_);
}

ObjReading ObjBuilder::finish() {
  if (!reading_.error.empty()) {
    reading_.mesh = nullptr;
    return std::move(reading_);
  }
  auto say = [&](size_t count, const char* what) {
    if (count) reading_.warnings.push_back(path_ + ": " + std::to_string(count) + what);
  };
  say(too_small_, " faces with fewer than three corners skipped");
  say(not_finite_, " faces with a vertex that is not finite skipped");
  say(zero_area_, " triangles without area skipped");
  if (mesh().triangles.empty()) {
    reading_.error = path_ + ": " + (faces_ ? "no face is left" : "has no faces");
    reading_.mesh = nullptr;
    return std::move(reading_);
  }
  bool any_uv = false;
  for (const Mesh::Corners& t : mesh().uv_corners)
    any_uv |= t[0] != Mesh::kNoIndex;
  if (!any_uv) mesh().uv_corners.clear();
  if (reading_.materials.size() <= 1) mesh().material_slots.clear();
  if (!smoothing_stated_) smoothing_.groups.clear();
  compute_missing_normals(mesh(), smoothing_);
  return std::move(reading_);
}

/// One line at a time, so that the builder knows which line a callback belongs to.
class LineFeeder : public std::streambuf {
public:
  explicit LineFeeder(ObjBuilder& builder) : builder_(builder) {}

private:
  int_type underflow() override {
    if (!builder_.feed(line_)) return traits_type::eof();
    line_ += '\n';
    setg(line_.data(), line_.data(), line_.data() + line_.size());
    return traits_type::to_int_type(line_[0]);
  }
  ObjBuilder& builder_;
  std::string line_;
};

ObjBuilder& builder_of(void* user) { return *static_cast<ObjBuilder*>(user); }

} // namespace

ObjReading parse_obj(const std::string& path, std::string_view text, const Folders& folders) {
  ObjBuilder builder(path, text, folders);
  LineFeeder feeder(builder);
  std::istream stream(&feeder);
  tinyobj::callback_t callback;
  using Real = tinyobj::real_t;
  callback.vertex_cb = [](void* user, Real x, Real y, Real z, Real) { builder_of(user).vertex({x, y, z}); };
  callback.normal_cb = [](void* user, Real x, Real y, Real z) { builder_of(user).normal({x, y, z}); };
  callback.texcoord_cb = [](void* user, Real u, Real v, Real) { builder_of(user).uv({u, v}); };
  callback.index_cb = [](void* user, tinyobj::index_t* corners, int count) {
    builder_of(user).face(corners, size_t(std::max(0, count)));
  };
  std::string warnings, errors;
  tinyobj::LoadObjWithCallback(stream, callback, &builder, nullptr, &warnings, &errors);
  return builder.finish();
}

ObjReading read_obj(const std::string& path, const Folders& folders) {
  FileText file = read_file(path);
  if (!file.error.empty()) return {nullptr, {}, file.error, {}};
  return parse_obj(path, file.text, folders);
}

Model model_of_obj(const std::string& path, const Folders& folders) {
  ObjReading obj = read_obj(path, folders);
  Model model;
  model.error = std::move(obj.error);
  model.warnings = std::move(obj.warnings);
  if (!obj.mesh) return model;
  model.materials = std::move(obj.materials);
  Object object;
  object.name = path;
  object.mesh = obj.mesh;
  for (uint32_t m = 0; m < model.materials.size(); ++m)
    object.materials.push_back(m);
  model.objects.push_back(std::move(object));
  return model;
}

} // namespace moonshade::renderer
