// The public interface of libbrume.
//
//   std::vector<std::string> warnings;
//   brume::Scene scene = brume::Scene::load("smoke.vdb", warnings);
//   brume::render(scene).write("smoke.exr");
#pragma once

#include "brume/bench.h"
#include "brume/compare.h"
#include "brume/make.h"
#include "brume/phase.h"
#include "brume/render.h"
#include "brume/scene.h"
#include "brume/statistics.h"
