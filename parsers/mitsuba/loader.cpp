#include "mitsuba/loader.h"

#include <algorithm>
#include <filesystem>

#include "base/readable.h"
#include "mitsuba/property_values.h"
#include "mitsuba/references.h"
#include "mitsuba/text.h"

namespace duet {

namespace {

constexpr int kDeepestInclude = 16, kDeepestNesting = 64;
constexpr int kMostIncludes = 10000;
constexpr size_t kMostNodes = 4'000'000;

std::optional<FileVersion> parse_version(std::string_view text) {
  int parts[3] = {0, 0, 0};
  size_t i = 0;
  for (std::string_view rest = trim(text);; ++i) {
    const size_t dot = rest.find('.');
    const auto part = parse_integer(rest.substr(0, dot));
    if (i == 3 || !part || *part < 0 || *part > 1000) return std::nullopt;
    parts[i] = int(*part);
    if (dot == rest.npos) break;
    rest = rest.substr(dot + 1);
  }
  return FileVersion{parts[0], parts[1], parts[2]};
}

class Loader {
 public:
  Loader(const MitsubaOptions& options, const FileAccess& access, Report& report)
      : options_(options),
        access_(access),
        report_(report),
        substitution_(options.defines),
        references_(report) {}

  NodeTree load(const std::string& file) {
    tree_.nodes.emplace_back().kind = PluginKind::scene;
    tree_.nodes.front().plugin = find_plugin(PluginKind::scene, "scene");
    const SourceLocation nowhere{std::make_shared<const std::string>(file), 0, 0};
    load_file(file, tree_.nodes.front(), options_.search_paths, nowhere, "");
    references_.resolve();
    tree_.parameters = substitution_.scene_parameters();
    return std::move(tree_);
  }

 private:
  /// One file with what is valid for it.
  struct File {
    std::unique_ptr<XmlDocument> xml;
    FileVersion version;
    std::shared_ptr<std::vector<std::string>> folders;
  };

  /// Appends the plugins of a file to `parent`. `where` names it and `name` is the name that a file
  /// with a plugin as its root gets.
  void load_file(const std::string& path, Node& parent, const std::vector<std::string>& folders,
                 const SourceLocation& where, const std::string& name) {
    const std::string key = std::filesystem::path(path).lexically_normal().string();
    if (std::find(open_files_.begin(), open_files_.end(), key) != open_files_.end()) {
      report_.error(where, "{} includes itself", path);
      return;
    }
    if (open_files_.size() >= kDeepestInclude) {
      report_.error(where, "files are included more than {} deep", kDeepestInclude);
      return;
    }
    auto text = access_.read(path);
    if (!text) {
      const std::string why = unreadable_reason(path);
      report_.error(where, "cannot read {}{}", path, why.empty() ? "" : ": " + why);
      return;
    }
    File file;
    file.xml =
        XmlDocument::parse(std::move(*text), std::make_shared<const std::string>(path), report_);
    if (!file.xml) return;
    file.folders = std::make_shared<std::vector<std::string>>(folders);
    file.folders->insert(file.folders->begin(), folder_of(path));

    const pugi::xml_node root = file.xml->root();
    if (!read_version(file, root)) return;
    open_files_.push_back(key);
    const bool main = open_files_.size() == 1;
    if (std::string_view(root.name()) == "scene") {
      Attributes(*file.xml, root, substitution_, report_).check({"!version", "id", "name", "type"});
      if (main) {
        parent.version = file.version;
        parent.where = file.xml->where(root);
        parent.folders = file.folders;
      }
      load_children(file, root, parent, 1);
    } else if (main) {
      report_.error(file.xml->where(root), "the root of a scene file is <scene>, not <{}>",
                    root.name());
    } else {
      load_element(file, root, parent, 1, name);
    }
    open_files_.pop_back();
  }

  bool read_version(File& file, pugi::xml_node root) {
    const pugi::xml_attribute attribute = root.attribute("version");
    if (!attribute) {
      report_.error(file.xml->where(root), "<{}> needs the attribute \"version\"", root.name());
      return false;
    }
    const SourceLocation where = file.xml->where(attribute);
    const auto version = parse_version(attribute.value());
    if (!version) {
      report_.error(where, "{} is not a version of the form 3.0.0", in_quotes(attribute.value()));
      return false;
    }
    if (*version < FileVersion{0, 4, 0}) {
      report_.error(where,
                    "scenes of Mitsuba {} are not understood, only those of 0.4 to 3; Mitsuba 0.6 "
                    "can convert it",
                    attribute.value());
      return false;
    }
    if (version->major > 3)
      report_.warning(where, "version {} is unknown; the scene is read as version 3",
                      attribute.value());
    file.version = *version;
    return true;
  }

  void load_children(File& file, pugi::xml_node element, Node& parent, int depth) {
    for (pugi::xml_node child : element.children()) {
      if (child.type() == pugi::node_element) {
        load_element(file, child, parent, depth, "");
      } else if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata) {
        report_.warning(file.xml->where(element), "the text {} in <{}> has no meaning",
                        in_quotes(trim(child.value())), element.name());
      }
    }
  }

  /// `name` is that of the <include>, if the element is the root of the included file.
  void load_element(File& file, pugi::xml_node element, Node& parent, int depth,
                    const std::string& name) {
    const std::string_view tag = element.name();
    const SourceLocation where = file.xml->where(element);
    if (depth > kDeepestNesting) {
      report_.error(where, "elements are nested more than {} deep", kDeepestNesting);
      return;
    }
    const auto kind = kind_of_tag(tag);
    if (kind && *kind != PluginKind::scene)
      return load_plugin(file, element, *kind, parent, depth, name);
    if (tag == "spectrum" && element.attribute("type"))
      return load_plugin(file, element, PluginKind::texture, parent, depth, name);

    const Attributes attributes(*file.xml, element, substitution_, report_);
    if (is_value_element(tag)) return load_value(file, element, attributes, parent);
    if (tag == "ref") return load_reference(attributes, parent);
    if (tag == "include") return load_include(file, attributes, parent);
    if (tag == "default") {
      if (attributes.check({"!name", "!value"}))
        substitution_.set_default(attributes["name"], attributes["value"]);
    } else if (tag == "alias") {
      if (attributes.check({"!id", "!as"}))
        references_.add_alias(attributes["as"], attributes["id"], where);
    } else if (tag == "path") {
      load_path(file, attributes);
    } else if (tag == "scene") {
      report_.error(where, "<scene> can only be the root of a file");
    } else if (tag == "camera" || tag == "luminaire") {
      report_.error(where, "<{}> is a name of Mitsuba 0.3; it is <{}> now", tag,
                    tag == "camera" ? "sensor" : "emitter");
    } else {
      report_.error(where, "unknown element <{}>{}", tag,
                    did_you_mean(std::string(tag), all_tags()));
    }
  }

  static std::vector<std::string> all_tags() {
    std::vector<std::string> tags = value_elements();
    for (int i = 0; i < kPluginKinds; ++i) tags.emplace_back(tag_of(PluginKind(i)));
    for (const char* t : {"ref", "include", "default", "alias", "path"}) tags.emplace_back(t);
    return tags;
  }

  void load_plugin(File& file, pugi::xml_node element, PluginKind kind, Node& parent, int depth,
                   const std::string& name) {
    const Attributes a(*file.xml, element, substitution_, report_);
    const bool root = depth == 1 && element == file.xml->root();
    const bool valid =
        root ? a.check({"!type", "id", "name", "version"}) : a.check({"!type", "id", "name"});
    if (tree_.nodes.size() >= kMostNodes) {
      if (tree_.nodes.size() == kMostNodes)
        report_.error(a.where(), "a scene has at most {} plugins", kMostNodes);
      return;
    }
    Node& node = tree_.nodes.emplace_back();
    node.kind = kind;
    node.type = file.version.is_0x() ? to_lower(a["type"]) : a["type"];
    node.id = a["id"];
    node.version = file.version;
    node.where = a.where();
    node.folders = file.folders;
    if (valid) find_node_plugin(node, a.where("type"));
    if (!node.id.empty()) references_.add_id(node, a.where("id"));
    const std::string& written = a.has("name") ? a["name"] : name;
    parent.properties.push_back({snake_case(written), written, &node, node.where, node.where});
    load_children(file, element, node, depth + 1);
  }

  void find_node_plugin(Node& node, const SourceLocation& where) {
    const Plugin* plugin = find_plugin(node.kind, node.type);
    const std::string_view tag = tag_of(node.kind);
    if (plugin && plugin->support == Support::refused) {
      report_.error(where, "{} type \"{}\" is refused: {}", tag, node.type, plugin->note);
    } else if (plugin) {
      node.plugin = plugin;
      node.type = plugin->name;
    } else {
      std::string hint = did_you_mean(node.type, plugin_names(node.kind));
      for (int i = 0; i < kPluginKinds && hint.empty(); ++i)
        if (find_plugin(PluginKind(i), node.type))
          hint = fmt::format(" (there is a {} of that name)", tag_of(PluginKind(i)));
      report_.error(where, "unknown {} type {}{}", tag, in_quotes(node.type), hint);
    }
  }

  void load_value(File& file, pugi::xml_node element, const Attributes& a, Node& parent) {
    const ElementContext context{*file.xml, file.version,  substitution_,
                                 access_,   *file.folders, report_};
    PropertyValue value = read_value(context, element, a);
    const std::string& name = a["name"];
    if (name.empty() && !std::holds_alternative<NullReference>(value)) return;
    const SourceLocation& where = a.where(a.has("filename")      ? "filename"
                                          : a.has("temperature") ? "temperature"
                                                                 : "value");
    parent.properties.push_back({snake_case(name), name, std::move(value), a.where(), where});
  }

  void load_reference(const Attributes& a, Node& parent) {
    if (!a.check({"!id", "name"})) return;
    parent.properties.push_back(
        {snake_case(a["name"]), a["name"], Broken{}, a.where(), a.where("id")});
    references_.add_reference(parent, a["id"], a.where("id"));
  }

  void load_include(File& file, const Attributes& a, Node& parent) {
    if (!a.check({"!filename", "name"})) return;
    const SourceLocation& where = a.where("filename");
    if (++includes_ > kMostIncludes) {
      if (includes_ == kMostIncludes + 1)
        report_.error(where, "more than {} files are included", kMostIncludes);
      return;
    }
    const auto path = find_file(a["filename"], *file.folders, access_);
    if (!path) {
      report_.error(where, "{}", not_found(a["filename"], *file.folders));
      return;
    }
    load_file(*path, parent, *file.folders, where, a["name"]);
  }

  void load_path(File& file, const Attributes& a) {
    if (!a.check({"!value"})) return;
    if (const auto path = find_file(a["value"], *file.folders, access_))
      file.folders->insert(file.folders->begin(), *path);
    else
      report_.error(a.where("value"), "{}", not_found(a["value"], *file.folders));
  }

  const MitsubaOptions& options_;
  const FileAccess& access_;
  Report& report_;
  Substitution substitution_;
  NodeTree tree_;
  std::vector<std::string> open_files_;
  References references_;
  int includes_ = 0;
};

}  // namespace

std::string describe(const Node& node) {
  if (node.kind == PluginKind::scene) return "<scene>";
  return fmt::format("<{} type=\"{}\">", tag_of(node.kind), node.type);
}

NodeTree load_tree(const std::string& file, const MitsubaOptions& options, const FileAccess& access,
                   Report& report) {
  return Loader(options, access, report).load(file);
}

}  // namespace duet
