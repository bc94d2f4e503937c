// The extension module duet._duet. What users see is in duet/*.py, which calls it.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <future>
#include <memory>
#include <mutex>
#include <tuple>

#include "duet/duet.h"
#include "math/statistics.h"
#include "python/plugin_names.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace duet::python {

namespace {

using Texts = std::vector<std::string>;
using Assignments = std::vector<std::pair<std::string, std::string>>;

SceneFile load(const std::string& name, const std::optional<std::string>& text,
               const Assignments& defines, const Texts& search_paths) {
  const nb::gil_scoped_release others_may_run;
  const SceneFileOptions options{defines, search_paths};
  return text ? SceneFile::from_text(*text, options) : SceneFile::load(name, options);
}

/// A render on a thread of its own, so that the calling one can answer to Python: to Ctrl-C, and to
/// those who watch the progress.
class WatchedRender {
 public:
  WatchedRender(const SceneFile& scene, const RenderSettings& settings)
      : render_(std::async(std::launch::async, [this, scene, settings] {
          return render_file(scene, settings,
                             {.progress = [this](const RenderedShare& p) { set_progress(p); },
                              .warning = [this](const std::string& w) { warnings_.push_back(w); },
                              .cancel = &cancel_});
        })) {}
  ~WatchedRender() {
    cancel_ = true;
    const nb::gil_scoped_release others_may_run;
    if (render_.valid()) render_.wait();
  }

  /// Waits for the image. `watch` is None or gets fraction, samples per pixel and seconds.
  std::optional<RenderedImage> wait(const nb::object& watch) {
    while (!is_ready()) {
      // An exception of a signal's handler: Ctrl-C gets the samples so far, another one ends it.
      if (PyErr_CheckSignals() != 0) {
        if (!PyErr_ExceptionMatches(PyExc_KeyboardInterrupt)) throw nb::python_error();
        PyErr_Clear();
        cancel_ = true;
      }
      if (!watch.is_none()) tell(watch);
    }
    return render_.get();
  }
  const Texts& warnings() const { return warnings_; }

 private:
  bool is_ready() const {
    const nb::gil_scoped_release others_may_run;
    return render_.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
  }
  void tell(const nb::object& watch) {
    const RenderedShare p = progress();
    try {
      watch(p.fraction, p.spp, p.seconds);
    } catch (const nb::python_error& e) {
      if (!e.matches(PyExc_KeyboardInterrupt)) throw;
      cancel_ = true;
    }
  }
  void set_progress(const RenderedShare& p) {
    const std::lock_guard lock(mutex_);
    progress_ = p;
  }
  RenderedShare progress() {
    const std::lock_guard lock(mutex_);
    return progress_;
  }

  std::atomic<bool> cancel_{false};
  std::mutex mutex_;
  RenderedShare progress_;
  Texts warnings_;  ///< to be read when the render has ended
  std::future<std::optional<RenderedImage>> render_;
};

RenderedTechniques technique_layers(const std::string& name) {
  return name == "raw"        ? RenderedTechniques::raw
         : name == "weighted" ? RenderedTechniques::weighted
                              : RenderedTechniques::none;
}

/// The image and the warnings.
std::pair<RenderedImage, Texts> render(const SceneFile& scene, const RenderSettings& settings,
                                       const nb::object& watch) {
  WatchedRender render(scene, settings);
  std::optional<RenderedImage> image = render.wait(watch);
  if (!image) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw nb::python_error();
  }
  return {std::move(*image), render.warnings()};
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
      .def("json", &SceneFile::info_json)
      .def("summary", &SceneFile::summary);
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
  m.def("merge", &merge_films, "films"_a, nb::call_guard<nb::gil_scoped_release>());
  m.def("render", &render, "scene"_a, "settings"_a, "watch"_a.none());
}

void bind_image(nb::module_& m) {
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
          "path"_a, "display"_a, "exr"_a, nb::call_guard<nb::gil_scoped_release>())
      .def("png", [](const RenderedImage& i) {
        const std::vector<uint8_t> bytes = i.png();
        return nb::bytes(bytes.data(), bytes.size());
      });
}

void bind_compare(nb::module_& m) {
  nb::class_<ComparedImage>(m, "ComparedImage")
      .def_static("load", &ComparedImage::load, "path"_a)
      .def_static(
          "from_pixels",
          [](const Pixels& p, const Texts& channels) {
            return ComparedImage::from_pixels(numbers(p), int(p.shape(1)), int(p.shape(0)),
                                              channels);
          },
          "pixels"_a, "channels"_a)
      .def_static("from_image", &ComparedImage::from_image, "image"_a);
  nb::class_<ReferenceVariance>(m, "Variance")
      .def(nb::init<ComparedImage, double, double>(), "variance"_a, "image_spp"_a,
           "reference_spp"_a);
  m.def("compare", &compare_images, "image"_a, "reference"_a, "variance"_a.none(), "threads"_a = 0,
        nb::call_guard<nb::gil_scoped_release>());
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
