/* Shades the points of object.test through the object's functions and prints them as `shaderc --run` does. */
#include "pits.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "broken.h"
#include "second.h"

#ifdef DOUBLE
typedef double number;
#define FORMAT "%.17g"
#else
typedef float number;
#define FORMAT "%.9g"
#endif

enum { COUNT = 200 };

static const char* const names[] = {"none",  "index",    "division",   "assert",
                                    "error", "for-step", "step-limit", "integer-range"};

static number x[COUNT], y[COUNT], z[COUNT], u[COUNT], v[COUNT];
static int64_t frame[COUNT], steps[COUNT];
static uint8_t backface[COUNT], beyond[COUNT], codes[COUNT];
static number r[COUNT], g[COUNT], b[COUNT], h[COUNT];

static void points(uint64_t count) {
  for (uint64_t k = 0; k < count; ++k) {
    x[k] = (number)(k % 10) / 8 - (number)0.25;
    y[k] = (number)(k % 7) / 4;
    z[k] = (number)(k % 67) / 128;
    u[k] = (number)0.5;
    v[k] = 0;
    frame[k] = (int64_t)(k % 11);
    backface[k] = k % 3 == 0;
  }
}

static void print_points(FILE* file, uint64_t count) {
  fprintf(file, "p.x,p.y,p.z,uv.x,uv.y,frame,backface\n");
  for (uint64_t k = 0; k < count; ++k)
    fprintf(file, FORMAT "," FORMAT "," FORMAT ",0.5,0,%" PRId64 ",%s\n", x[k], y[k], z[k], frame[k],
            backface[k] ? "true" : "false");
}

int main(int argc, char** argv) {
  const uint64_t count = COUNT - 3; /* no multiple of any width */
  points(count);
  if (argc > 1 && strcmp(argv[1], "points") == 0) {
    print_points(stdout, count);
    return 0;
  }

  pits_instance instance;
  pits_parameters parameters = PITS_DEFAULTS;
  parameters.scale = 100;
  const char* error = pits_instantiate(&instance, &parameters);
  if (error == NULL || strcmp(error, "parameter 'scale' is outside its range") != 0) return 10;
  parameters.scale = 8;
  parameters.mode = "shallow";
  error = pits_instantiate(&instance, &parameters);
  if (error == NULL || strcmp(error, "parameter 'mode' is none of its choices") != 0) return 16;
  parameters.mode = "odd \"?\"";
  parameters.sharp = false;
  parameters.class_[0] = 1;
  error = pits_instantiate(&instance, argc > 1 && strcmp(argv[1], "set") == 0 ? &parameters : NULL);
  if (error != NULL) return 11;

  pits_height_batch heights = {count, x, y, z, h, NULL, NULL};
  pits_height(&instance, &heights);
  for (uint64_t k = 0; k < count; ++k)
    printf(FORMAT "\n", h[k]);

  moonshade_faults faults;
  memset(&faults, 0x55, sizeof faults);
  pits_shade_batch colors = {count, x, y, z, u, v, frame, backface, r, g, b, steps, beyond, &faults, codes};
  pits_shade(&instance, &colors);
  for (uint64_t k = 0; k < count; ++k)
    if (codes[k] != MOONSHADE_FAULT_NONE)
      printf("fault: %s\n", names[codes[k]]);
    else
      printf(FORMAT ", " FORMAT ", " FORMAT ", %" PRId64 ", %s\n", r[k], g[k], b[k], steps[k],
             beyond[k] ? "true" : "false");
  const moonshade_fault_site* site = &pits_fault_sites[faults.first_site];
  fprintf(stderr, "%" PRIu64 " faults, the first at point %" PRIu64 ": %s:%u:%u: %s %s\n", faults.count,
          faults.first_point, site->file, (unsigned)site->line, (unsigned)site->column, site->kind, site->message);

  pits_instantiate_entry_batch third = {3, x, y, z, h, NULL, NULL};
  pits_instantiate_entry(&instance, &third);
  if (h[2] != x[2]) return 15;

  /* Another shader in the same program, with names of its own. */
  second_instance other;
  if (second_instantiate(&other, NULL) != NULL) return 12;
  number value = 0, result = -1;
  second_height_batch one = {1, &value, &result, NULL, NULL};
  second_height(&other, &one);
  if (result != 42) return 13;

  broken_instance broken;
  error = broken_instantiate(&broken, NULL);
  if (error == NULL || strstr(error, "broken.lua:3:14: the top level faults: division") == NULL) return 14;
  return 0;
}
