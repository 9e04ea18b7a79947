sphere { material = material { name = "broken", shader = "broken.lua" } }
