#include "evaluate/stability/catalogue.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/diagnostics.h"
#include "evaluate/stability/checks.h"
#include "evaluate/stability/json_object.h"

namespace duet::stability {

namespace {

std::vector<std::string> method_names() {
  return {kMethods.begin(), kMethods.end()};
}

Settings read_settings(const JsonObject& from, const JsonValue* j) {
  Settings settings;
  if (!j) return settings;
  if (!j->is_object()) from.fail("names with values are needed");
  for (const auto& [name, value] : j->items()) {
    if (value.is_structured()) from.fail(fmt::format("\"{}\" needs one value", name));
    settings[name] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  return settings;
}

void check_method(const JsonObject& from, const std::string& name) {
  const std::vector<std::string> known = method_names();
  if (std::find(known.begin(), known.end(), name) == known.end())
    from.fail(fmt::format("there is no method \"{}\"{}", name, did_you_mean(name, known)));
}

MethodSettings read_method_settings(const JsonObject& from, const JsonValue* j) {
  MethodSettings all;
  if (!j) return all;
  if (!j->is_object()) from.fail("settings of methods are needed");
  for (const auto& [method, settings] : j->items()) {
    if (method != "*") check_method(from, method);
    all[method] = read_settings(from, &settings);
  }
  return all;
}

/// "holds", {"fails": [least, most], "why": …} or {"not applicable": why}.
Expectation read_expectation(const JsonObject& row, const std::string& method, const JsonValue& j) {
  Expectation e;
  if (j == "holds") return e;
  JsonObject o(j, fmt::format("{}, \"{}\"", row.where(), method));
  if (o.has("not applicable")) {
    e.verdict = Expected::not_applicable;
    e.why = o.text("not applicable");
  } else {
    e.verdict = Expected::fails;
    const auto bounds = o.get<std::vector<double>>("fails", {});
    if (bounds.size() != 2 || !(bounds[0] <= bounds[1]))
      o.fail("\"fails\" needs the least and the greatest size of the failure");
    e.least = bounds[0], e.most = bounds[1];
    e.why = o.text("why");
  }
  o.check_keys();
  return e;
}

void read_methods(JsonObject& o, Row& row) {
  const JsonValue* j = o.find("methods");
  if (!j || !j->is_object()) o.fail("\"methods\" has to say what is expected of each");
  for (const auto& [method, ignored] : j->items())
    if (method != "*") check_method(o, method);
  for (const std::string method : kMethods) {
    if (method == kChoice && !j->contains(method)) {
      row.methods[method] = {Expected::not_applicable, 0, 0, "runs one of the others"};
      continue;
    }
    const auto at = j->contains(method) ? j->find(method) : j->find("*");
    if (at == j->end()) o.fail(fmt::format("nothing is expected of \"{}\"", method));
    row.methods[method] = read_expectation(o, method, *at);
  }
}

std::vector<Variant> read_variants(const JsonObject& row, const JsonValue* j) {
  std::vector<Variant> variants;
  if (!j) return {Variant{}};
  for (const JsonValue& one : *j) {
    JsonObject o(one, row.where() + ", variant");
    Variant v;
    v.label = o.text("label");
    v.defines = read_settings(o, o.find("define"));
    v.parameters = read_method_settings(o, o.find("parameters"));
    v.value = o.number("value");
    o.check_keys();
    variants.push_back(std::move(v));
  }
  if (variants.empty()) row.fail("\"variants\" is empty");
  return variants;
}

Draw read_draw(const JsonObject& row, const JsonValue* j) {
  Draw draw;
  if (!j) return draw;
  JsonObject o(*j, row.where() + ", draw");
  draw.count = o.count("count", 0, 1);
  const JsonValue* names = o.find("define");
  if (!names || !names->is_object()) o.fail("\"define\" is missing");
  for (const auto& [name, from] : names->items()) {
    Draw::Name n{name, {}, 0, 0};
    if (!from.is_array() || from.size() < 2) o.fail(fmt::format("\"{}\" needs a list", name));
    if (from[0].is_string()) {
      for (const JsonValue& text : from) n.texts.push_back(text.get<std::string>());
    } else {
      n.least = from[0], n.most = from[1];
      if (!(n.least > 0) || !(n.most > n.least))
        o.fail(fmt::format("\"{}\" needs two positive numbers", name));
    }
    draw.names.push_back(std::move(n));
  }
  o.check_keys();
  return draw;
}

std::string scene_file(const JsonObject& from, const std::string& folder, const std::string& name) {
  if (name.empty()) return "";
  std::string path = folder + "/" + name;
  if (!name.ends_with(".xml")) path += "/scene.xml";
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) from.fail(fmt::format("there is no scene {}", path));
  return path;
}

Reference read_reference(const JsonObject& row, const JsonValue* j, const std::string& folder) {
  Reference r;
  if (!j) return r;
  JsonObject o(*j, row.where() + ", reference");
  r.method = o.get<std::string>("method", "");
  if (!r.method.empty() && r.method != "self") check_method(o, r.method);
  r.scene = scene_file(o, folder, o.get<std::string>("scene", ""));
  r.defines = read_settings(o, o.find("define"));
  r.parameters = read_settings(o, o.find("parameters"));
  if (const JsonValue* sum = o.find("sum"))
    for (const JsonValue& one : *sum) r.sum.push_back(read_settings(o, &one));
  r.fixed = o.get<bool>("fixed", false);
  r.independent = o.get<bool>("independent", false);
  r.spp = o.count("spp", 0, 0);
  r.batches = o.count("batches", 0, 0);
  r.value = o.number("value");
  o.check_keys();
  return r;
}

Region read_region(JsonObject& o, const std::string& key) {
  const Region whole{0, 0, 1, 1}, r = o.get<Region>(key, whole);
  if (!(r[0] >= 0 && r[0] < r[2] && r[2] <= 1 && r[1] >= 0 && r[1] < r[3] && r[3] <= 1))
    o.fail(fmt::format("\"{}\" needs x0, y0, x1, y1 between 0 and 1", key));
  return r;
}

void check_statistic(const JsonObject& o, const Row& row) {
  std::vector<std::string> known;
  for (const Check& c : checks()) known.emplace_back(c.name);
  const auto at = std::find(known.begin(), known.end(), row.check);
  if (at == known.end())
    o.fail(fmt::format("there is no check \"{}\"{}; there are {}", row.check,
                       did_you_mean(row.check, known), fmt::join(known, ", ")));
  const bool has_value = row.reference.value || row.variants[0].value;
  const Check& check = checks()[size_t(at - known.begin())];
  if (check.needs_reference && row.reference.method.empty() && !has_value)
    o.fail(fmt::format("check \"{}\" needs a reference", row.check));
  if (row.limit && !check.limit_text) o.fail(fmt::format("check \"{}\" has no limit", row.check));
  if (row.margin && !check.margin) o.fail(fmt::format("check \"{}\" has no margin", row.check));
}

Row read_row(const JsonValue& j, const std::string& folder, size_t index) {
  Row row;
  JsonObject o(j, fmt::format("{}/catalogue.json: row {}", folder,
                              j.is_object() && j.contains("name") ? j["name"].dump()
                                                                  : fmt::to_string(index + 1)));
  row.name = o.text("name");
  row.number = o.count("number", 0, 0);
  row.title = o.text("title");
  row.about = o.get<std::string>("about", "");
  row.planned = o.get<std::string>("planned", "");
  // The rest waits for the day on which it can run.
  if (!row.planned.empty()) return row;
  row.check = o.text("check");
  row.scene = scene_file(o, folder, o.text("scene"));
  row.fast = o.get<bool>("fast", false);
  row.defines = read_settings(o, o.find("define"));
  row.parameters = read_method_settings(o, o.find("parameters"));
  for (const auto& [method, factor] : o.get<std::map<std::string, double>>("effort", {})) {
    check_method(o, method);
    row.effort[method] = factor;
  }
  row.spp = o.count("spp", row.spp, 1);
  row.batches = o.count("batches", row.batches, 1);
  row.independent = o.get<bool>("independent", false);
  row.variants = read_variants(o, o.find("variants"));
  row.draw = read_draw(o, o.find("draw"));
  row.reference = read_reference(o, o.find("reference"), folder);
  row.limit = o.number("limit");
  row.margin = o.number("margin");
  row.tiles = o.count("tiles", row.tiles, 1);
  row.most_batches = o.count("most_batches", row.most_batches, 1);
  row.target_error = o.number("target_error");
  row.region = read_region(o, "region");
  row.over = read_region(o, "over");
  read_methods(o, row);
  o.check_keys();
  check_statistic(o, row);
  return row;
}

}  // namespace

bool merges(const std::string& method) {
  return method == "ppm" || method == "bpm" || method == "vcm";
}

int Catalogue::measured_cells() const {
  int cells = 0;
  for (const Row& row : rows)
    for (const auto& [method, e] : row.methods) cells += e.verdict != Expected::not_applicable;
  return cells;
}

Settings merged(Settings under, const Settings& over) {
  for (const auto& [name, value] : over) under[name] = value;
  return under;
}

Settings settings_for(const MethodSettings& all, const std::string& method) {
  Settings settings;
  for (const std::string& key : {std::string("*"), method})
    if (const auto at = all.find(key); at != all.end()) settings = merged(settings, at->second);
  return settings;
}

Catalogue read_catalogue(const std::string& folder) {
  const std::string path = folder + "/catalogue.json";
  std::ifstream file(path);
  if (!file) throw CatalogueError(fmt::format("cannot read the catalogue {}", path));
  JsonValue json;
  try {
    json = JsonValue::parse(file);
  } catch (const JsonValue::exception& e) {
    throw CatalogueError(fmt::format("{}: {}", path, e.what()));
  }
  if (!json.is_array()) throw CatalogueError(path + ": a list of rows is needed");
  Catalogue catalogue;
  catalogue.folder = folder;
  std::set<std::string> names;
  for (const JsonValue& j : json) {
    try {
      catalogue.rows.push_back(read_row(j, folder, catalogue.rows.size()));
    } catch (const JsonValue::exception& e) {
      throw CatalogueError(
          fmt::format("{}: row {}: {}", path, catalogue.rows.size() + 1, e.what()));
    }
    if (!names.insert(catalogue.rows.back().name).second)
      throw CatalogueError(
          fmt::format("{}: two rows are called \"{}\"", path, catalogue.rows.back().name));
  }
  return catalogue;
}

}  // namespace duet::stability
