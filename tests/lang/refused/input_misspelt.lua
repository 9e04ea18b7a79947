function height(p, tme, dpdx, q)
  return p.x
end
-- error: 1:20 unknown-input
-- error: 1:25 unknown-input
-- error: 1:31 unknown-input
