#include "support/foreign_plugin.h"

#include <doctest/doctest.h>

#include "mitsuba/writer.h"
#include "scene/content_hash.h"

namespace duet::test {

ForeignPlugin::ForeignPlugin(PluginKind kind, const Plugin& plugin) {
  vocabulary_.add(kind, plugin);
}

ReadResult ForeignPlugin::read(const std::string& scene) const {
  MitsubaOptions options;
  options.vocabulary = &vocabulary_;
  return read_with(options, scene);
}

SceneDescription ForeignPlugin::good(const std::string& scene) const {
  const ReadResult r = read(scene);
  REQUIRE_MESSAGE(r.scene, r.messages());
  CHECK(r.messages() == "");
  return r.description();
}

std::string ForeignPlugin::round_trip(const SceneDescription& scene) const {
  const MitsubaXml xml = write_mitsuba_xml(scene);
  CHECK(xml.losses.empty());
  const ReadResult again = read(xml.text);
  REQUIRE_MESSAGE(again.scene, again.messages());
  CHECK(again.description() == scene);
  CHECK(content_hash(again.description()) == content_hash(scene));
  return xml.text;
}

}  // namespace duet::test
