/* Tartan's C interface: compile rule files, match plans, open plan libraries, grow surfaces, mesh fields, place parts,
 * map and breed genomes, and draw. Include this one header; docs/c-interface.md is the guide.
 *
 *   base.h       versions, errors, progress and cancelling, memory
 *   module.h     compiled rule files
 *   compile.h    rule files into modules, and their layout
 *   source.h     rule files with their source: tests, coverage, reports
 *   ask.h        questions about rule files, as JSON
 *   plan.h       plans, rules that match them, libraries of them
 *   measure.h    measures of libraries: how plans are spread, the best of them, open plans
 *   house.h      libraries of houses, and houses as meshes and files
 *   analysis.h   why a rule matches, what rules mean, how libraries differ
 *   mesh.h       meshes as arrays and as files
 *   growth.h     surfaces that grow
 *   field.h      implicit surfaces, meshed
 *   place.h      models of parts, placed
 *   genome.h     grammars: genomes mapped to sentences and back
 *   evolution.h  sentences bred by a fitness of yours
 *   run.h        runs of `tartan evolve`, read back
 *   draw.h       pictures in memory
 *
 * Libraries. libtartan has all of this, and links the others. A program that only runs modules (.tnb), which
 * `tartan build` or libtartan made, links what it needs:
 *
 *   libtartan-runtime  base, module, plan, measure, analysis, field, place, genome, evolution; mesh.h but files
 *   libtartan-growth   growth
 *   libtartan-mesh     mesh files, smoothing and so on
 *   libtartan-draw     draw
 *   libtartan-store    run
 *
 * compile.h, source.h, ask.h and house.h are in libtartan alone. Each has a pkg-config file of its name (tartan,
 * tartan-runtime) and is a target of the CMake package (find_package(tartan): tartan::tartan, tartan::tartan-runtime).
 *
 * Ownership. What a function hands out through a `**` argument is the caller's, to be freed with the _free function of
 * its type (texts: tartan_text_free; files in memory: tartan_bytes_free); where it fails, it leaves that as it was.
 * What it returns as a pointer to const is borrowed from the object asked. An object borrows those that it was made of:
 * free it before them, the module last. Arrays and texts that a caller passes are copied or used during the call only,
 * where no comment says otherwise.
 *
 * Options. A struct that callers own begins with its size, so that later versions can add fields. Make one with its
 * _init function, and set what you want: the zeros that it leaves mean the default. A size that is too small, or fields
 * that this version of the library does not know and that are not zero, are TARTAN_INVALID. Where a function fills such
 * a struct, it fills as much as `size` says. Structs without a size are elements of arrays; they only change with the
 * minor version.
 *
 * Threads. Modules, schemas, rules, libraries, grammars, meshes and what analysis.h hands out do not change once made,
 * and may be used by many threads at once; every other object belongs to one thread at a time. Results never depend on
 * the number of threads.
 *
 * Errors. A function that can fail returns a tartan_status and describes the failure in the tartan_error given, which
 * may be NULL. Nothing here prints, exits or aborts, and nothing reads the environment. Pointers must not be NULL
 * unless a comment says that they may; a NULL object is TARTAN_INVALID where a function returns a status.
 */
#ifndef TARTAN_TARTAN_H
#define TARTAN_TARTAN_H

#include "analysis.h"
#include "ask.h"
#include "base.h"
#include "compile.h"
#include "draw.h"
#include "evolution.h"
#include "field.h"
#include "genome.h"
#include "growth.h"
#include "house.h"
#include "measure.h"
#include "mesh.h"
#include "module.h"
#include "place.h"
#include "plan.h"
#include "run.h"
#include "source.h"

#endif
