-- Errs where who requires it also err
function module(p) return nothing end
return { module = module }
