#include "mitsuba/loader.h"

#include <algorithm>
#include <filesystem>

#include "base/readable.h"
#include "mitsuba/references.h"
#include "values/text.h"
#include "xml/scene_file.h"
#include "xml/value_elements.h"

namespace duet {

namespace {

constexpr int kDeepestInclude = 16;
constexpr int kMostIncludes = 10000;
constexpr size_t kMostNodes = 4'000'000;
constexpr std::string_view kWayOut = "; -i METHOD renders the scene with another one";

class Loader {
 public:
  Loader(const MitsubaOptions& options, const FileAccess& access, Report& report)
      : options_(options),
        access_(access),
        vocabulary_(options.vocabulary ? *options.vocabulary : Vocabulary::built_in()),
        report_(report),
        substitution_(options.defines),
        references_(report) {}

  NodeTree load(const std::string& file) {
    tree_.nodes.emplace_back().kind = PluginKind::scene;
    tree_.nodes.front().plugin = vocabulary_.find(PluginKind::scene, "scene");
    const SourceLocation nowhere{std::make_shared<const std::string>(file), 0, 0};
    load_file(file, tree_.nodes.front(), options_.search_paths, nowhere, "");
    references_.resolve();
    tree_.parameters = substitution_.scene_parameters();
    tree_.integrator_replaced = !options_.replacing_methods.empty();
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
    auto parsed = parse_scene_file(std::move(*text), path, access_, report_);
    if (!parsed) return;
    File file{std::move(parsed->xml), parsed->version, nullptr};
    file.folders = std::make_shared<std::vector<std::string>>(folders);
    file.folders->insert(file.folders->begin(), folder_of(path));

    const pugi::xml_node root = file.xml->root();
    open_files_.push_back(key);
    const bool annotations = substitution_.keeps_annotations();
    substitution_.keep_annotations(file.version.is_0x());
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
    substitution_.keep_annotations(annotations);
    open_files_.pop_back();
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
        substitution_.set_default(attributes["name"], attributes.expansion("value"));
    } else if (tag == "alias") {
      if (attributes.check({"!id", "!as"}))
        references_.add_alias(attributes["as"], attributes["id"], where);
    } else if (tag == "path") {
      load_path(file, attributes);
    } else if (tag == "mode") {
      report_.warning(where, "<mode> is no element of Mitsuba and has no effect");
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
    node.replaced = valid && is_replaced(node, element, file);
    if (valid) find_node_plugin(node, a.where("type"));
    if (!node.id.empty()) references_.add_id(node, a.where("id"));
    const std::string& written = a.has("name") ? a["name"] : name;
    parent.properties.push_back({snake_case(written), written, &node, node.where, node.where});
    const Report::Mute mute(report_, node.replaced);
    load_children(file, element, node, depth + 1);
  }

  /// Whether the integrator is one in whose place another method is run, and holds none that is
  /// run.
  bool is_replaced(const Node& node, pugi::xml_node element, const File& file) {
    if (node.kind != PluginKind::integrator || options_.replacing_methods.empty()) return false;
    const Plugin* plugin = vocabulary_.find(node.kind, node.type);
    for (const char* layers : {"aov", "moment", "field", "multichannel"})
      if (plugin && plugin->name == layers) return false;
    const Report::Mute mute(report_);
    return !names_run_method(element, file);
  }

  bool names_run_method(pugi::xml_node element, const File& file) {
    const Attributes a(*file.xml, element, substitution_, report_);
    const auto& methods = options_.replacing_methods;
    const std::string type = file.version.is_0x() ? to_lower(a["type"]) : a["type"];
    if (std::find(methods.begin(), methods.end(), type) != methods.end()) return true;
    for (pugi::xml_node nested : element.children("integrator"))
      if (names_run_method(nested, file)) return true;
    return false;
  }

  void find_node_plugin(Node& node, const SourceLocation& where) {
    const Plugin* plugin = vocabulary_.find(node.kind, node.type);
    const std::string_view tag = tag_of(node.kind);
    const bool refused = plugin && plugin->support == Support::refused;
    const bool integrator = node.kind == PluginKind::integrator;
    if (node.replaced && (refused || !plugin)) {
      report_.warning(where, "the integrator \"{}\" is {}: {} takes its place", node.type,
                      refused ? "refused" : "unknown", fmt::join(options_.replacing_methods, ", "));
      // Its name for what the methods share.
      node.plugin = vocabulary_.find(node.kind, "path");
    } else if (refused) {
      report_.error(where, "{} type \"{}\" is refused: {}{}", tag, node.type, plugin->note,
                    integrator ? kWayOut : "");
    } else if (plugin) {
      node.plugin = plugin;
      node.type = plugin->name;
    } else {
      std::string hint = did_you_mean(node.type, vocabulary_.names(node.kind));
      for (int i = 0; i < kPluginKinds && hint.empty(); ++i)
        if (vocabulary_.find(PluginKind(i), node.type))
          hint = fmt::format(" (there is a {} of that name)", tag_of(PluginKind(i)));
      report_.error(where, "unknown {} type {}{}{}", tag, in_quotes(node.type), hint,
                    integrator ? kWayOut : "");
    }
  }

  void load_value(File& file, pugi::xml_node element, const Attributes& a, Node& parent) {
    const ElementContext context{*file.xml, file.version,  substitution_,
                                 access_,   *file.folders, report_};
    PropertyValue value = read_value(context, element, a);
    const std::string& name = a["name"];
    if (name.empty() && !std::holds_alternative<NullReference>(value)) return;
    const SourceLocation& where = a.has("filename")      ? a.where("filename")
                                  : a.has("temperature") ? a.where("temperature")
                                  : a.has("value")       ? a.where("value")
                                                         : a.where_all();
    parent.properties.push_back({snake_case(name), name, std::move(value), a.where(), where});
  }

  void load_reference(const Attributes& a, Node& parent) {
    if (!a.check({"!id", "name"})) return;
    parent.properties.push_back(
        {snake_case(a["name"]), a["name"], Broken{}, a.where(), a.where("id")});
    if (report_.is_muted()) return;
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
  const Vocabulary& vocabulary_;
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
