function height(p)
  if p then return 1 end
  return 0
end
-- error: 2:6 condition-type
