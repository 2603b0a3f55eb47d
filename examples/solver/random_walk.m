% A solver in Octave: steps from the best point known, shorter where they fail, longer where they succeed.
% Asked for points of the unit box and told their costs, a line of JSON each way; docs/own-solver.md has the protocol.
problem = jsondecode(input("", "s"));  % fgetl would wait for what follows the line
rand("twister", problem.seed);
randn("twister", problem.seed);
n = problem.dimension;
best = rand(1, n);
lowest = Inf;
step = 0.3;
points = [best; rand(9, n)];
while true
  printf("{\"ask\": %s}\n", jsonencode(num2cell(points, 2)));
  fflush(stdout);
  try
    costs = jsondecode(input("", "s")).tell;
  catch  % the budget is used
    break;
  end
  [cost, k] = min(costs);
  if cost < lowest
    lowest = cost;
    best = points(k, :);
    step = min(1.5 * step, 0.5);
  else
    step = max(0.7 * step, 1e-6);
  end
  points = min(1, max(0, best + step * randn(10, n)));
end
