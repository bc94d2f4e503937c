// The extension module duet._duet. What users see is in duet/*.py, which calls it.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <stdexcept>
#include <tuple>

#include "duet/duet.h"
#include "evaluate/report/exposure.h"
#include "math/statistics.h"
#include "python/calls.h"
#include "python/plugin_names.h"
#include "python/watched_render.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace duet::python {

namespace {

/// Of calls that touch no Python object.
using Unlocked = nb::call_guard<OthersMayRun>;

using Texts = std::vector<std::string>;
using Assignments = std::vector<std::pair<std::string, std::string>>;

SceneFile load(const std::string& name, const std::optional<std::string>& text,
               const Assignments& defines, const Texts& search_paths) {
  const OthersMayRun others_may_run;
  const SceneFileOptions options{defines, search_paths};
  return text ? SceneFile::from_text(*text, options) : SceneFile::load(name, options);
}

RenderedTechniques technique_layers(const std::string& name) {
  return name == "raw"        ? RenderedTechniques::raw
         : name == "weighted" ? RenderedTechniques::weighted
                              : RenderedTechniques::none;
}

nb::object metadata_value(const MetadataValue& value) {
  struct Converted {
    nb::object operator()(const std::string& v) const { return nb::cast(v); }
    nb::object operator()(float v) const { return nb::cast(double(v)); }
    nb::object operator()(int v) const { return nb::cast(v); }
    nb::object operator()(const std::array<float, 16>& v) const {
      return nb::cast(std::vector<float>(v.begin(), v.end()));
    }
  };
  return std::visit(Converted{}, value);
}

nb::typed<nb::dict, nb::str, nb::object> metadata_of(const RenderedImage& image) {
  nb::typed<nb::dict, nb::str, nb::object> fields;
  for (const auto& [name, value] : image.metadata()) fields[name.c_str()] = metadata_value(value);
  return fields;
}

/// The pixels without a copy: the array keeps the image.
nb::ndarray<nb::numpy, const float, nb::ndim<3>> pixels(const nb::object& self) {
  const auto& image = nb::cast<const RenderedImage&>(self);
  return nb::ndarray<nb::numpy, const float, nb::ndim<3>>(
      image.pixels().data(),
      {size_t(image.height()), size_t(image.width()), image.channels().size()}, self);
}

using Pixels = nb::ndarray<const float, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

std::span<const float> numbers(const Pixels& pixels) {
  return {pixels.data(), pixels.size()};
}

/// Stops, and whether they are on top of an automatic exposure. Throws std::invalid_argument.
std::pair<double, bool> exposure(const std::string& text) {
  const std::optional<Exposure> exposure = exposure_of(text);
  if (!exposure) throw std::invalid_argument("exposure: " + not_an_exposure(text));
  return {exposure->stops, exposure->automatic};
}

std::vector<uint8_t> png(const RenderedImage& image) {
  const OthersMayRun others_may_run;
  return image.png();
}

void bind_exceptions(nb::module_& m) {
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const SceneError& e) {
      Texts all;
      for (const SceneMessage& message : e.messages()) all.push_back(message.text);
      const SceneMessage& first = e.first();
      const nb::object error = nb::module_::import_("duet").attr("SceneError")(
          e.what(), first.file.empty() ? nb::none() : nb::cast(first.file), first.line,
          first.column, all);
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(error.ptr())), error.ptr());
    } catch (const DenoiserError& e) {
      PyErr_SetString(nb::module_::import_("duet").attr("DenoiserError").ptr(), e.what());
    } catch (const MemoryError& e) {
      PyErr_SetString(PyExc_MemoryError, e.what());
    } catch (const FileError& e) {
      PyErr_SetString(PyExc_OSError, e.what());
    }
  });
  m.def("version", &library_version);
}

void bind_scene(nb::module_& m) {
  nb::class_<SceneFile>(m, "Scene")
      .def_prop_ro("name", &SceneFile::name)
      .def_prop_ro("warnings", &SceneFile::warnings)
      .def("json", &SceneFile::info_json, Unlocked())
      .def("summary", &SceneFile::summary, Unlocked());
  m.def("plugin_kinds", &plugin_kinds, "type"_a, "outer"_a);
  m.def("parameter_type", &parameter_type, "element"_a, "type"_a, "name"_a);
  m.def("load", &load, "name"_a, "text"_a.none(), "defines"_a, "search_paths"_a);
}

void bind_render(nb::module_& m) {
  nb::class_<RenderSettings>(m, "Settings")
      .def(nb::init<>())
      .def_rw("spp", &RenderSettings::spp, nb::arg().none())
      .def_rw("seconds", &RenderSettings::seconds, nb::arg().none())
      .def_rw("target_error", &RenderSettings::target_error, nb::arg().none())
      .def_rw("integrator", &RenderSettings::integrator)
      .def_rw("parameters", &RenderSettings::parameters)
      .def_rw("layers", &RenderSettings::layers)
      .def_rw("cryptomatte", &RenderSettings::cryptomatte)
      .def_rw("denoise", &RenderSettings::denoise)
      .def(
          "set_techniques",
          [](RenderSettings& s, const std::string& name) { s.techniques = technique_layers(name); },
          "name"_a)
      .def_rw("seed", &RenderSettings::seed, nb::arg().none())
      .def_rw("strict_sampler", &RenderSettings::strict_sampler)
      .def_rw("threads", &RenderSettings::threads)
      .def_rw("size", &RenderSettings::size, nb::arg().none())
      .def_rw("crop", &RenderSettings::crop, nb::arg().none())
      .def_rw("sensor", &RenderSettings::sensor);
  m.def("merge", &merge_films, "films"_a, Unlocked());
  m.def("end_calls", &end_calls);
  m.def("forget_calls", &forget_calls);
  m.def("render", &render, "scene"_a, "settings"_a, "watch"_a.none());
}

void bind_image(nb::module_& m) {
  m.def("exposure", &exposure, "text"_a);
  nb::class_<DisplayForm>(m, "DisplayForm")
      .def(
          "__init__",
          [](DisplayForm* self, double exposure, bool automatic, const std::string& tone_map,
             int png_depth) {
            new (self) DisplayForm{exposure, automatic, tone_map, png_depth};
          },
          "exposure"_a, "automatic"_a, "tone_map"_a, "png_depth"_a);
  nb::class_<ExrForm>(m, "ExrForm")
      .def(
          "__init__",
          [](ExrForm* self, const std::string& aov_names, bool parts) {
            new (self) ExrForm{aov_names, parts};
          },
          "aov_names"_a, "parts"_a);
  nb::class_<RenderedImage>(m, "Image")
      .def_static(
          "from_rgba",
          [](const Pixels& p) {
            const OthersMayRun others_may_run;
            return RenderedImage::from_rgba(numbers(p), int(p.shape(1)), int(p.shape(0)));
          },
          "pixels"_a)
      .def_prop_ro("channels", &RenderedImage::channels)
      .def_prop_ro("interrupted", &RenderedImage::interrupted)
      .def_prop_ro("denoised", &RenderedImage::denoised)
      .def_prop_ro("metadata", &metadata_of)
      .def("pixels", &pixels)
      .def(
          "save",
          [](const RenderedImage& i, const std::string& path, const DisplayForm& display,
             const ExrForm& exr) { i.save(path, display, exr); },
          "path"_a, "display"_a, "exr"_a, Unlocked())
      .def("png", [](const RenderedImage& i) {
        const std::vector<uint8_t> bytes = png(i);
        return nb::bytes(bytes.data(), bytes.size());
      });
}

void bind_compare(nb::module_& m) {
  nb::class_<ComparedImage>(m, "ComparedImage")
      .def_static("load", &ComparedImage::load, "path"_a, Unlocked())
      .def_static(
          "from_pixels",
          [](const Pixels& p, const Texts& channels) {
            const OthersMayRun others_may_run;
            return ComparedImage::from_pixels(numbers(p), int(p.shape(1)), int(p.shape(0)),
                                              channels);
          },
          "pixels"_a, "channels"_a)
      .def_static("from_image", &ComparedImage::from_image, "image"_a, Unlocked());
  nb::class_<ReferenceVariance>(m, "Variance")
      .def(nb::init<ComparedImage, double, double>(), "variance"_a, "image_spp"_a,
           "reference_spp"_a);
  m.def("compare", &compare_images, "image"_a, "reference"_a, "variance"_a.none(), "threads"_a = 0,
        Unlocked());
  m.def(
      "welch",
      [](const std::vector<double>& values, double expected, double variance) {
        const MeanEstimate mean = estimate_mean(values);
        const WelchTest test = welch_test(mean, {expected, variance, 0});
        return std::tuple(mean.mean - expected, test.error, test.p,
                          normal_of_student(test.t, test.dof));
      },
      "values"_a, "expected"_a, "variance"_a);
}

}  // namespace

}  // namespace duet::python

NB_MODULE(_duet, m) {
  using namespace duet::python;
  bind_exceptions(m);
  bind_scene(m);
  bind_render(m);
  bind_image(m);
  bind_compare(m);
}
