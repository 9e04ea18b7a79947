-- Modules: tables of functions and constants, each run once, whoever requires it.
local stone = require "modules.stone"
local helpers = require("modules.deep.helpers")
local triangle <const> = require("modules.deep.helpers").triangle

function height(p)
  return stone.bumps(p) * helpers.gain + stone.table[2] + stone.count()
end
-- run: height p=0,0,0
-- expect: 11.875
-- run: height p=0,0,0 -D rough=4
-- expect: 12.25

function color(p)
  return shared(p) * triangle(p.x)
end
-- run: color p=0,2,0
-- expect: 5, 1, 0.5
